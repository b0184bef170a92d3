/**
 * The thin client of the REST interface: JSON in and out, errors as `ApiError`.
 *
 *     const objects = await api.get<ObjectSummary[]>(`/projects/${projectId}/objects`);
 *     await api.put(`/projects/${projectId}/objects/${objectId}`, { base_revision, data });
 *
 * Every request carries `X-Tappet-Client`, which a foreign page cannot set: the server refuses changes without it.
 */

const BASE = '/api/v1';

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

type Query = Record<string, string | number | boolean | null | undefined>;

interface RequestOptions {
  query?: Query;
  signal?: AbortSignal;
}

/** Called for every answer 401, so that the frame can show the login page. */
let onUnauthorised: () => void = () => undefined;
export function setUnauthorisedListener(listener: () => void): void {
  onUnauthorised = listener;
}

function apiUrl(path: string, query?: Query): string {
  const search = new URLSearchParams();
  for (const [name, value] of Object.entries(query ?? {})) if (value != null) search.set(name, String(value));
  const text = search.toString();
  return BASE + path + (text ? `?${text}` : '');
}

/** Address of a WebSocket below `/api/v1`, with the page's own host and scheme. */
export function socketUrl(path: string, query?: Query): string {
  const scheme = location.protocol === 'https:' ? 'wss:' : 'ws:';
  return `${scheme}//${location.host}${apiUrl(path, query)}`;
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

async function request<Answer>(
  method: string,
  path: string,
  body: unknown,
  options: RequestOptions = {},
): Promise<Answer> {
  const headers: Record<string, string> = { Accept: 'application/json', 'X-Tappet-Client': '1' };
  const init: RequestInit = { method, headers, credentials: 'same-origin', signal: options.signal };
  if (body instanceof FormData) init.body = body;
  else if (body !== undefined) {
    headers['Content-Type'] = 'application/json';
    init.body = JSON.stringify(body);
  }
  let response: Response;
  try {
    response = await fetch(apiUrl(path, options.query), init);
  } catch (cause) {
    if (cause instanceof DOMException && cause.name === 'AbortError') throw cause;
    throw new ApiError({ title: 'The server does not answer', status: 0 });
  }
  if (!response.ok) {
    if (response.status === 401) onUnauthorised();
    throw new ApiError(await problemOf(response));
  }
  if (response.status === 204) return undefined as Answer;
  const type = response.headers.get('Content-Type') ?? '';
  return (type.includes('json') ? await response.json() : await response.blob()) as Answer;
}

export const api = {
  get: <Answer>(path: string, options?: RequestOptions) => request<Answer>('GET', path, undefined, options),
  post: <Answer>(path: string, body?: unknown, options?: RequestOptions) =>
    request<Answer>('POST', path, body, options),
  put: <Answer>(path: string, body: unknown, options?: RequestOptions) => request<Answer>('PUT', path, body, options),
  patch: <Answer>(path: string, body: unknown, options?: RequestOptions) =>
    request<Answer>('PATCH', path, body, options),
  delete: <Answer>(path: string, options?: RequestOptions) => request<Answer>('DELETE', path, undefined, options),
};
