/**
 * The client of the REST interface: openapi-fetch on the generated types, with data as answer and errors as `ApiError`.
 *
 *     const objects = await api.get('/api/v1/projects/{project_id}/objects', { params: { path: { project_id } } });
 *     await api.post('/api/v1/projects', { body: { name } });
 *
 * Paths, parameters, bodies and answers are those of `schema.ts`: what the server does not know does not compile.
 * Every request carries `X-Tappet-Client`, which a foreign page cannot set: the server refuses changes without it, and
 * `Accept-Language`, the language of the user, in which the server says its sentences.
 */
import createClient, {
  type Client,
  type ClientPathsWithMethod,
  type FetchOptions,
  type Middleware,
} from 'openapi-fetch';
import { language, t } from '@/i18n';
import type { paths } from './schema';

/** RFC 9457 problem details as the server sends them, with the fields of the single problem. */
export interface Problem {
  type?: string;
  title: string;
  status: number;
  detail?: string;
  [field: string]: unknown;
}

/** The server refused or failed; `status` 0 means that it could not be reached. */
export class ApiError extends Error {
  readonly status: number;
  readonly problem: Problem;

  constructor(problem: Problem) {
    super(problem.detail ?? problem.title);
    this.name = 'ApiError';
    this.status = problem.status;
    this.problem = problem;
  }
}

/** A cancelled request is an answer of its own, not a failure. */
export function isCancelled(error: unknown): boolean {
  return error instanceof DOMException && error.name === 'AbortError';
}

/** Called for every answer 401, so that the frame can show the login page. */
let onUnauthorised: () => void = () => undefined;
export function setUnauthorisedListener(listener: () => void): void {
  onUnauthorised = listener;
}

async function problemOf(response: Response): Promise<Problem> {
  const fallback: Problem = { title: response.statusText || `HTTP ${response.status}`, status: response.status };
  try {
    const body: unknown = await response.json();
    if (typeof body === 'object' && body !== null) return { ...fallback, ...body, status: response.status };
  } catch {
    // A proxy or a crashed server may answer without JSON: the status line has to do.
  }
  return fallback;
}

const languageOfUser: Middleware = {
  onRequest({ request }) {
    request.headers.set('Accept-Language', language());
    return request;
  },
};

const errors: Middleware = {
  async onResponse({ response }) {
    if (response.ok) return;
    if (response.status === 401) onUnauthorised();
    throw new ApiError(await problemOf(response));
  },
  onError: ({ error }) => (isCancelled(error) ? undefined : new ApiError({ title: t('error.noServer'), status: 0 })),
};

/** A body as JSON; one that holds files as a form, without the fields that are null. */
function serialised(body: unknown): BodyInit {
  const fields = typeof body === 'object' && body !== null ? Object.entries(body) : [];
  const values = fields.flatMap(([name, value]: [string, unknown]) =>
    (Array.isArray(value) ? (value as unknown[]) : [value]).map((one) => ({ name, one })),
  );
  if (!values.some(({ one }) => one instanceof Blob)) return JSON.stringify(body);
  const form = new FormData();
  for (const { name, one } of values) {
    if (one instanceof Blob) form.append(name, one);
    else if (one != null) form.append(name, typeof one === 'string' ? one : JSON.stringify(one));
  }
  return form;
}

const client = createClient<paths>({
  credentials: 'same-origin',
  headers: { 'X-Tappet-Client': '1' },
  bodySerializer: serialised,
  fetch: (request) => fetch(request),
});
client.use(languageOfUser, errors);

type Method = 'get' | 'post' | 'put' | 'patch' | 'delete';
type Paths<Verb extends Method> = ClientPathsWithMethod<Client<paths>, Verb>;
type Operation<Verb extends Method, Path extends Paths<Verb>> = paths[Path][Verb];
type Options<Of> = Pick<FetchOptions<Of>, Extract<keyof FetchOptions<Of>, 'params' | 'body' | 'signal' | 'keepalive'>>;
type Arguments<Of> = object extends Options<Of> ? [options?: Options<Of>] : [options: Options<Of>];
type Responses<Of> = Of extends { responses: infer All } ? All[keyof All & (200 | 201 | 204)] : never;
type Data<Of> = Responses<Of> extends { content: infer Content } ? Content[keyof Content] : undefined;

/** Paths that answer with a file, some of them with a text in place of an archive. */
type Files = { [Path in Paths<'get'>]: Blob extends Data<Operation<'get', Path>> ? Path : never }[Paths<'get'>];

/** A request of one method: resolves with the data of the answer, throws `ApiError` or, when cancelled, `AbortError`. */
function request<Verb extends Method>(verb: Verb, parseAs: 'json' | 'blob' = 'json') {
  return async <Path extends Paths<Verb>>(
    path: Path,
    ...[options]: Arguments<Operation<Verb, Path>>
  ): Promise<Data<Operation<Verb, Path>>> => {
    const init = { ...options, parseAs, baseUrl: location.origin };
    const { data } = await client.request(verb, path, init as never);
    return data as Data<Operation<Verb, Path>>;
  };
}

export const api = {
  get: request('get'),
  post: request('post'),
  put: request('put'),
  patch: request('patch'),
  delete: request('delete'),
  /** A file; its type is the media type that the server names. */
  download: request('get', 'blob') as <Path extends Files>(
    path: Path,
    ...options: Arguments<Operation<'get', Path>>
  ) => Promise<Blob>,
};

/**
 * A request whose path is known at run time only: the path below the server's root with its query, the body as JSON.
 * Resolves with the data of the answer, a text where it is no JSON, undefined where it has none.
 */
export async function requestAny(verb: Method, path: string, body: unknown, signal: AbortSignal): Promise<unknown> {
  const init = { body, signal, parseAs: 'text', baseUrl: location.origin };
  const answer: unknown = await client.request(verb, path as never, init as never);
  const { data, response } = answer as { data?: string; response: Response };
  if (data === undefined || data === '') return undefined;
  return /\bjson\b/.test(response.headers.get('content-type') ?? '') ? (JSON.parse(data) as unknown) : data;
}

/** As `requestAny`, for an answer that is no text. */
export async function requestBytes(path: string, signal: AbortSignal): Promise<ArrayBuffer> {
  const init = { signal, parseAs: 'arrayBuffer', baseUrl: location.origin };
  const answer: unknown = await client.request('get', path as never, init as never);
  return (answer as { data: ArrayBuffer }).data;
}

/** Sends a file as it is, not as a form; resolves with the data of the answer. */
export async function sendFile(path: string, file: Blob): Promise<unknown> {
  const init = {
    body: file,
    bodySerializer: (body: Blob) => body,
    headers: { 'Content-Type': 'application/octet-stream' },
    baseUrl: location.origin,
  };
  const answer: unknown = await client.request('post', path as never, init as never);
  return (answer as { data?: unknown }).data;
}

/** Address of a WebSocket below `/api/v1`, with the page's own host and scheme. */
export function socketUrl(path: `/${string}`, query: Record<string, string> = {}): string {
  const scheme = location.protocol === 'https:' ? 'wss:' : 'ws:';
  const search = new URLSearchParams(query).toString();
  return `${scheme}//${location.host}/api/v1${path}${search ? `?${search}` : ''}`;
}
