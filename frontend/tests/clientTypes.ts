/** Requests that must not compile: `npm run typecheck` fails where one of them begins to. */
import { api } from '@/api/client';

const path = { project_id: 'p' };
export const refused = {
  // @ts-expect-error: there is no such path.
  'an unknown path': () => api.get('/api/v1/project'),
  // @ts-expect-error: the path has no such method.
  'an unknown method': () => api.patch('/api/v1/projects', { body: { name: 'x' } }),
  // @ts-expect-error: project_id is missing.
  'missing parameters': () => api.get('/api/v1/projects/{project_id}'),
  // @ts-expect-error: object_id is missing.
  'a missing parameter': () => api.get('/api/v1/projects/{project_id}/objects/{object_id}', { params: { path } }),
  // @ts-expect-error: the parameter is called project_id.
  'a misspelt parameter': () => api.get('/api/v1/projects/{project_id}', { params: { path: { project: 'p' } } }),
  // @ts-expect-error: the query has no such field.
  'a misspelt query': () => api.get('/api/v1/projects', { params: { query: { delete: true } } }),
  // @ts-expect-error: a body is needed.
  'a missing body': () => api.post('/api/v1/projects'),
  // @ts-expect-error: the name is a text.
  'a wrong field': () => api.post('/api/v1/projects', { body: { name: 1 } }),
  // @ts-expect-error: projects have no such field.
  'a field too many': () => api.post('/api/v1/projects', { body: { name: 'x', nmae: 'y' } }),
  // @ts-expect-error: only these two words are known.
  'a wrong word': () => api.post('/api/v1/projects', { body: { name: 'x', template: 'big' } }),
  // @ts-expect-error: files are files.
  'a wrong file': () => api.post('/api/v1/libraries', { body: { file: 'text' } }),
  // @ts-expect-error: this path answers with JSON.
  'a download of JSON': () => api.download('/api/v1/projects'),
  'an answer of another shape': async () => {
    const [project] = await api.get('/api/v1/projects');
    // @ts-expect-error: projects have no such field.
    const title: unknown = project?.title;
    return title;
  },
};
