/** Requests of scripts: which are let through, and the client that makes them. */
import { ApiError, requestAny } from '@/api/client';
import { t } from '@/i18n';
import type { Query, ScriptRequest, Verb } from './protocol';

const ROOT = '/api/v1';
/** Accounts, their tokens and what each user has set: no script acts as somebody's hand there. */
const CLOSED: readonly string[] = ['auth', 'me', 'users'];
const VERBS: readonly Verb[] = ['get', 'post', 'put', 'patch', 'delete'];
/** A browser has about six connections to a server; the workbench needs some of them. */
const MOST_AT_ONCE = 3;

/** A request that is not passed on. */
export class RefusedRequest extends Error {}

/** The path and query of a request below `/api/v1` of this server. Throws `RefusedRequest` for any other. */
export function addressOf(path: string, query: Query | undefined): string {
  if (!path.startsWith('/')) throw new RefusedRequest(t('scripts.badPath', { path }));
  const url = new URL('http://server');
  try {
    url.href = new URL(`${ROOT}${path}`, url).href;
  } catch {
    throw new RefusedRequest(t('scripts.badPath', { path }));
  }
  const segments = decoded(url.pathname).split(/[/\\]+/);
  const outside = url.origin !== 'http://server' || segments[1] !== 'api' || segments[2] !== 'v1';
  if (outside || segments.includes('..')) throw new RefusedRequest(t('scripts.badPath', { path }));
  if (CLOSED.includes(segments[3]?.toLowerCase() ?? '')) throw new RefusedRequest(t('scripts.closedPath', { path }));
  for (const [name, value] of Object.entries(query ?? {})) {
    const values = typeof value === 'object' && value !== null ? value : [value];
    for (const one of values) {
      if (one != null) url.searchParams.append(name, String(one));
    }
  }
  return url.pathname + url.search;
}

function decoded(path: string): string {
  try {
    return decodeURIComponent(path);
  } catch {
    throw new RefusedRequest(t('scripts.badPath', { path }));
  }
}

/** Makes the requests of one run, a few at a time; what waits when the run ends is not made. */
export class ScriptClient {
  private readonly cancel = new AbortController();
  private readonly queue: (() => void)[] = [];
  private running = 0;

  async perform({ verb, path, query, body }: ScriptRequest): Promise<unknown> {
    if (!VERBS.includes(verb)) throw new RefusedRequest(t('scripts.badPath', { path: verb }));
    const address = addressOf(String(path), query);
    if (this.running >= MOST_AT_ONCE) await new Promise<void>((resolve) => this.queue.push(resolve));
    this.running += 1;
    try {
      this.cancel.signal.throwIfAborted();
      return await requestAny(verb, address, body, this.cancel.signal);
    } finally {
      this.running -= 1;
      this.queue.shift()?.();
    }
  }

  end(): void {
    this.cancel.abort();
  }
}

/** What the script is told of a request that failed. */
export function refusalOf(error: unknown): { status: number; message: string } {
  if (error instanceof ApiError) return { status: error.status, message: `${String(error.status)} ${error.message}` };
  return { status: 0, message: error instanceof Error ? error.message : String(error) };
}
