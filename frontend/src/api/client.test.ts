import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { setLanguage } from '@/i18n';
import { api, ApiError, isCancelled, setUnauthorisedListener } from './client';

const PROJECT = '/api/v1/projects/{project_id}';
const sent: Request[] = [];

/** What the server answers next. */
function answers(answer: (request: Request) => Response | Promise<Response>): void {
  vi.stubGlobal('fetch', (request: Request) => {
    sent.push(request);
    return Promise.resolve(answer(request));
  });
}

const json = (body: unknown, status = 200, type = 'application/json') =>
  new Response(JSON.stringify(body), { status, headers: { 'Content-Type': type } });

async function failure(promise: Promise<unknown>): Promise<ApiError> {
  const error: unknown = await promise.then(
    () => null,
    (reason: unknown) => reason,
  );
  expect(error).toBeInstanceOf(ApiError);
  return error as ApiError;
}

beforeEach(() => {
  sent.length = 0;
  vi.stubGlobal('document', { documentElement: {} });
  vi.stubGlobal('location', new URL('http://tappet.test/#/'));
});
afterEach(async () => {
  await setLanguage('en');
  vi.unstubAllGlobals();
  setUnauthorisedListener(() => undefined);
});

describe('a request', () => {
  it('goes to the own server, with the header that foreign pages cannot set', async () => {
    answers(() => json([]));
    expect(await api.get('/api/v1/projects')).toEqual([]);
    expect(sent[0]!.url).toBe('http://tappet.test/api/v1/projects');
    expect(sent[0]!.headers.get('X-Tappet-Client')).toBe('1');
    expect(sent[0]!.credentials).toBe('same-origin');
  });

  it('says the language of the user, as it is by then', async () => {
    answers(() => json([]));
    await api.get('/api/v1/projects');
    await setLanguage('zh');
    await api.get('/api/v1/projects');
    await api.post('/api/v1/projects', { body: { name: 'Press' } });
    expect(sent.map(({ headers }) => headers.get('Accept-Language'))).toEqual(['en', 'zh', 'zh']);
  });

  it('has its parameters in the path and in the query, arrays by repetition, null not at all', async () => {
    answers(() => json({}));
    await api.get('/api/v1/libraries/{name}', { params: { path: { name: 'A/B ü' }, query: { version: '*' } } });
    await api.download('/api/v1/projects/{project_id}/export', {
      params: { path: { project_id: 'p' }, query: { object: ['a', 'b c'], revision: null } },
    });
    expect(sent.map(({ url }) => url)).toEqual([
      'http://tappet.test/api/v1/libraries/A%2FB%20%C3%BC?version=*',
      'http://tappet.test/api/v1/projects/p/export?object=a&object=b%20c',
    ]);
  });

  it('carries its body as JSON', async () => {
    answers(() => json({ id: 'p' }, 201));
    await api.post('/api/v1/projects', { body: { name: 'Press' } });
    expect(sent[0]!.method).toBe('POST');
    expect(sent[0]!.headers.get('Content-Type')).toBe('application/json');
    expect(await sent[0]!.json()).toEqual({ name: 'Press' });
  });

  it.each([null, false, 0, 'text', ['a']])('carries %j as JSON too', async (body) => {
    answers(() => json(body));
    const answer = await api.put('/api/v1/me/settings/{key}', { params: { path: { key: 'x' } }, body });
    expect(answer).toEqual(body);
    expect(await sent[0]!.json()).toEqual(body);
  });

  it('carries files as a form, with their paths and without fields that are null', async () => {
    answers(() => json({}));
    const files = [new File(['a'], 'src/A.st'), new File(['b'], 'B.st')];
    await api.post('/api/v1/projects/import-files', { body: { files, chosen: null, name: 'Press' } });
    expect(sent[0]!.headers.get('Content-Type')).toMatch(/^multipart\/form-data; boundary=/);
    const form = await sent[0]!.formData();
    expect(form.getAll('files').map((file) => (file as File).name)).toEqual(['src/A.st', 'B.st']);
    expect(await (form.get('files') as File).text()).toBe('a');
    expect([form.get('name'), form.has('chosen')]).toEqual(['Press', false]);
  });
});

describe('an answer', () => {
  it('without content is undefined', async () => {
    answers(() => new Response(null, { status: 204 }));
    expect(await api.post('/api/v1/auth/logout')).toBeUndefined();
  });

  it('of null is null', async () => {
    answers(() => json(null));
    const params = { path: { runtime_id: 'local' } };
    expect(await api.get('/api/v1/runtimes/{runtime_id}/exception', { params })).toBeNull();
  });

  it('with a file has its media type and bytes', async () => {
    answers(() => new Response(new Uint8Array([80, 75, 0, 255]), { headers: { 'Content-Type': 'application/zip' } }));
    const blob = await api.download('/api/v1/projects/{project_id}/export', { params: { path: { project_id: 'p' } } });
    expect(blob.type).toBe('application/zip');
    expect([...new Uint8Array(await blob.arrayBuffer())]).toEqual([80, 75, 0, 255]);
  });
});

describe('a refusal', () => {
  it('is the problem that the server describes, with its own fields', async () => {
    const problem = { type: 'urn:tappet:problem:stale-revision', title: 'Stale', status: 409, detail: 'Newer.' };
    answers(() => json({ ...problem, current: { id: 'a' } }, 409, 'application/problem+json'));
    const error = await failure(api.get('/api/v1/projects'));
    expect(error.status).toBe(409);
    expect(error.message).toBe('Newer.');
    expect(error.problem).toEqual({ ...problem, current: { id: 'a' } });
  });

  it.each([
    [new Response('<html>', { status: 502, statusText: 'Bad Gateway' }), 502, 'Bad Gateway'],
    [new Response('', { status: 500 }), 500, 'HTTP 500'],
    [json('text', 503), 503, 'HTTP 503'],
    [json({ title: 'Lies', status: 200 }, 404), 404, 'Lies'],
  ])('without a problem is described by the status line', async (response, status, message) => {
    answers(() => response);
    const error = await failure(api.delete(PROJECT, { params: { path: { project_id: 'p' } } }));
    expect([error.status, error.problem.status, error.message]).toEqual([status, status, message]);
  });

  it('of 401, and no other, calls the listener', async () => {
    const listener = vi.fn();
    setUnauthorisedListener(listener);
    answers(() => json({ title: 'No' }, 403));
    await failure(api.get('/api/v1/projects'));
    expect(listener).not.toHaveBeenCalled();
    answers(() => json({ title: 'Sign in' }, 401));
    expect((await failure(api.get('/api/v1/projects'))).status).toBe(401);
    expect(listener).toHaveBeenCalledOnce();
  });

  it('has status 0 when the server does not answer', async () => {
    answers(() => Promise.reject(new TypeError('Failed to fetch')));
    const error = await failure(api.get('/api/v1/projects'));
    expect([error.status, error.message]).toEqual([0, 'The server does not answer']);
  });
});

describe('cancelling', () => {
  it('ends the request with an error of its own', async () => {
    const abort = new AbortController();
    answers(
      ({ signal }) =>
        new Promise((_, reject) => signal.addEventListener('abort', () => reject(signal.reason as DOMException))),
    );
    const running = api.post('/api/v1/projects/import-files', {
      body: { files: [new File(['a'], 'A.st')] },
      signal: abort.signal,
    });
    await vi.waitFor(() => expect(sent).toHaveLength(1));
    abort.abort();
    await expect(running).rejects.toSatisfy(isCancelled);
  });

  it('before it begins sends nothing that is waited for', async () => {
    answers(({ signal }) => (signal.aborted ? Promise.reject(signal.reason as DOMException) : json([])));
    await expect(api.get('/api/v1/projects', { signal: AbortSignal.abort() })).rejects.toSatisfy(isCancelled);
  });
});
