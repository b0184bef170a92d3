/**
 * Server state by TanStack Query: keys, queries, hooks and the acts that change objects.
 *
 * Reading: `useObjects(projectId)` is the tree (all summaries), `useObject(projectId, objectId, check)` one object with
 * its data, in the shape that `check` demands. Writing: `saveObject(...)`; a `StaleObject` error carries what somebody
 * else stored. The events socket (`workbench/events.ts`) keeps these caches fresh when somebody else changes something.
 */
import { QueryClient, queryOptions, useQuery, type UseQueryResult } from '@tanstack/react-query';
import { language } from '@/i18n';
import { api, ApiError } from './client';
import { shaped, type Check } from './objects';
import type { ObjectOf, ObjectSummary, ProjectObject } from './types';

export const queryClient = new QueryClient({
  defaultOptions: {
    queries: {
      staleTime: 30_000,
      refetchOnWindowFocus: false,
      retry: (count, error) => !(error instanceof ApiError && error.status >= 400 && error.status < 500) && count < 2,
    },
  },
});

export const keys = {
  projects: ['projects'] as const,
  project: (projectId: string) => ['project', projectId] as const,
  objects: (projectId: string) => ['project', projectId, 'objects'] as const,
  object: (projectId: string, objectId: string) => ['project', projectId, 'object', objectId] as const,
  testRuns: (projectId: string) => ['project', projectId, 'testRun'] as const,
  examples: ['examples'] as const,
  placement: ['placement'] as const,
  languages: ['languages'] as const,
  importFormats: ['importFormats'] as const,
  libraries: ['libraries'] as const,
  library: (name: string, version = '*') => ['libraries', name, version] as const,
  runtimes: ['runtimes'] as const,
  runtime: (runtimeId: string) => ['runtimes', runtimeId] as const,
  tasks: (runtimeId: string) => ['runtimes', runtimeId, 'tasks'] as const,
  log: (runtimeId: string) => ['runtimes', runtimeId, 'log'] as const,
};

/** Asked again wherever it is shown: no event tells of the projects that others make. */
export const projectsQuery = queryOptions({
  queryKey: keys.projects,
  queryFn: () => api.get('/api/v1/projects'),
  staleTime: 0,
});

/** Examples come with the server. */
export const examplesQuery = queryOptions({
  queryKey: keys.examples,
  queryFn: () => api.get('/api/v1/examples'),
  staleTime: Infinity,
});

export function projectQuery(projectId: string) {
  return queryOptions({
    queryKey: keys.project(projectId),
    queryFn: () => api.get('/api/v1/projects/{project_id}', { params: { path: { project_id: projectId } } }),
  });
}

export function objectQuery(projectId: string, objectId: string) {
  const path = { project_id: projectId, object_id: objectId };
  return queryOptions({
    queryKey: keys.object(projectId, objectId),
    queryFn: () => api.get('/api/v1/projects/{project_id}/objects/{object_id}', { params: { path } }),
    staleTime: Infinity,
  });
}

/** The last run of the unit tests of an application, and whether what it tested has changed since. */
export function testRunQuery(projectId: string, applicationId: string) {
  const path = { project_id: projectId, application_id: applicationId };
  return queryOptions({
    queryKey: [...keys.testRuns(projectId), applicationId],
    queryFn: () => api.get('/api/v1/projects/{project_id}/applications/{application_id}/tests', { params: { path } }),
    staleTime: Infinity,
  });
}

export const runtimesQuery = queryOptions({ queryKey: keys.runtimes, queryFn: () => api.get('/api/v1/runtimes') });

export function runtimeQuery(runtimeId: string) {
  return queryOptions({
    queryKey: keys.runtime(runtimeId),
    queryFn: () => api.get('/api/v1/runtimes/{runtime_id}', { params: { path: { runtime_id: runtimeId } } }),
  });
}

/** The installed libraries in all their versions. */
export const librariesQuery = queryOptions({
  queryKey: keys.libraries,
  queryFn: () => api.get('/api/v1/libraries'),
  staleTime: Infinity,
});

/** A library with all its items; without a version the newest one. */
export function libraryQuery(name: string, version = '*') {
  return queryOptions({
    queryKey: [...keys.library(name, version), language()], // its comments may be in it
    queryFn: () => api.get('/api/v1/libraries/{name}', { params: { path: { name }, query: { version } } }),
    staleTime: Infinity,
  });
}

export function useObjects(projectId: string | null): UseQueryResult<ObjectSummary[]> {
  const path = { project_id: projectId ?? '' };
  return useQuery({
    queryKey: keys.objects(projectId ?? ''),
    queryFn: () => api.get('/api/v1/projects/{project_id}/objects', { params: { path } }),
    enabled: projectId !== null,
    staleTime: Infinity,
  });
}

/** One object, in the shape that is expected of it; an object of another shape is an error. */
export function useObject<Data extends ProjectObject['data']>(
  projectId: string,
  objectId: string,
  check: Check<Data>,
): UseQueryResult<ObjectOf<Data>> {
  return useQuery({ ...objectQuery(projectId, objectId), select: (object) => shaped(object, check) });
}

/** Somebody else saved the object first. */
export class StaleObject extends Error {
  readonly current: ProjectObject;

  constructor(current: ProjectObject) {
    super(`'${current.name}' was changed by somebody else`);
    this.name = 'StaleObject';
    this.current = current;
  }
}

type Data = Record<string, unknown>;

/**
 * Saves an object's data on top of the revision it was read at and puts the answer into the caches.
 * Throws `StaleObject` when the revision is no longer the current one, `ApiError` otherwise. Autosaves shortly after
 * each other become one revision.
 */
export async function saveObject(
  projectId: string,
  objectId: string,
  baseRevision: number,
  data: Data,
  options: { autosave?: boolean } = {},
): Promise<ProjectObject> {
  try {
    const saved = await api.put('/api/v1/projects/{project_id}/objects/{object_id}', {
      params: { path: { project_id: projectId, object_id: objectId } },
      body: { base_revision: baseRevision, data, autosave: options.autosave },
    });
    remember(projectId, saved);
    return saved;
  } catch (error) {
    throw staleOf(error) ?? error;
  }
}

/** What a save of several objects holds for each of them. */
export interface ObjectContent {
  object_id: string;
  base_revision: number;
  data: Data;
}

/** As `saveObject`, for several objects as one change of the project: all of them are saved, or none. */
export async function saveObjects(
  projectId: string,
  objects: ObjectContent[],
  comment: string,
): Promise<ProjectObject[]> {
  try {
    const saved = await api.put('/api/v1/projects/{project_id}/objects', {
      params: { path: { project_id: projectId } },
      body: { objects, comment },
    });
    saved.forEach((object) => remember(projectId, object));
    return saved;
  } catch (error) {
    throw staleOf(error) ?? error;
  }
}

function remember(projectId: string, saved: ProjectObject): void {
  queryClient.setQueryData(keys.object(projectId, saved.id), saved);
  patchSummary(projectId, saved);
}

/** The conflict of a refusal, if it is one with a version of somebody else. */
function staleOf(error: unknown): StaleObject | null {
  if (!(error instanceof ApiError) || error.status !== 409) return null;
  const { current } = error.problem;
  return typeof current === 'object' && current !== null ? new StaleObject(current as ProjectObject) : null;
}

/** Puts a changed summary into the tree's cache. */
export function patchSummary(projectId: string, changed: ObjectSummary): void {
  queryClient.setQueryData<ObjectSummary[]>(keys.objects(projectId), (objects) =>
    objects?.map((object) =>
      object.id === changed.id && object.revision <= changed.revision ? { ...object, ...summaryOf(changed) } : object,
    ),
  );
}

export function summaryOf(object: ObjectSummary): ObjectSummary {
  const { id, parent_id, kind, subkind, name, index, revision, excluded } = object;
  return { id, parent_id, kind, subkind, name, index, revision, excluded };
}
