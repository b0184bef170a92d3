/**
 * Server state by TanStack Query: keys, hooks and the acts that change objects.
 *
 * Reading: `useObjects(projectId)` is the tree (all summaries), `useObject<TextData>(projectId, objectId)` one object
 * with its data. Writing: `saveObject(...)`; a `StaleObject` error carries both versions. The events socket
 * (`workbench/events.ts`) keeps these caches fresh when somebody else changes something.
 */
import { QueryClient, useQuery, type UseQueryResult } from '@tanstack/react-query';
import { api, ApiError } from './client';
import type { ObjectSummary, ProjectObject, ProjectSummary } from './types';

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

export function useProjects(): UseQueryResult<ProjectSummary[]> {
  return useQuery({ queryKey: keys.projects, queryFn: () => api.get<ProjectSummary[]>('/projects') });
}

export function useObjects(projectId: string | null): UseQueryResult<ObjectSummary[]> {
  return useQuery({
    queryKey: keys.objects(projectId ?? ''),
    queryFn: () => api.get<ObjectSummary[]>(`/projects/${projectId}/objects`),
    enabled: projectId !== null,
    staleTime: Infinity,
  });
}

export function useObject<Data>(projectId: string, objectId: string): UseQueryResult<ProjectObject<Data>> {
  return useQuery({
    queryKey: keys.object(projectId, objectId),
    queryFn: () => api.get<ProjectObject<Data>>(`/projects/${projectId}/objects/${objectId}`),
    staleTime: Infinity,
  });
}

/** Somebody else saved the object first: both versions, to compare. */
export class StaleObject<Data> extends Error {
  readonly current: ProjectObject<Data>;
  readonly yours: Data;

  constructor(current: ProjectObject<Data>, yours: Data) {
    super(`'${current.name}' was changed by somebody else`);
    this.name = 'StaleObject';
    this.current = current;
    this.yours = yours;
  }
}

/**
 * Saves an object's data on top of the revision it was read at and puts the answer into the caches.
 * Throws `StaleObject` when the revision is no longer the current one, `ApiError` otherwise. Autosaves shortly after
 * each other become one revision.
 */
export async function saveObject<Data>(
  projectId: string,
  objectId: string,
  baseRevision: number,
  data: Data,
  options: { autosave?: boolean } = {},
): Promise<ProjectObject<Data>> {
  try {
    const saved = await api.put<ProjectObject<Data>>(`/projects/${projectId}/objects/${objectId}`, {
      base_revision: baseRevision,
      data,
      autosave: options.autosave ?? false,
    });
    remember(projectId, saved);
    return saved;
  } catch (error) {
    throw staleOf(error, () => data) ?? error;
  }
}

/** What a save of several objects holds for each of them. */
export interface ObjectContent<Data> {
  object_id: string;
  base_revision: number;
  data: Data;
}

/** As `saveObject`, for several objects as one change of the project: all of them are saved, or none. */
export async function saveObjects<Data>(
  projectId: string,
  objects: readonly ObjectContent<Data>[],
  comment: string,
): Promise<ProjectObject<Data>[]> {
  try {
    const saved = await api.put<ProjectObject<Data>[]>(`/projects/${projectId}/objects`, { objects, comment });
    saved.forEach((object) => remember(projectId, object));
    return saved;
  } catch (error) {
    throw staleOf(error, (id) => objects.find((object) => object.object_id === id)?.data as Data) ?? error;
  }
}

function remember<Data>(projectId: string, saved: ProjectObject<Data>): void {
  queryClient.setQueryData(keys.object(projectId, saved.id), saved);
  patchSummary(projectId, saved);
}

/** The conflict of a refusal, if it is one with a version of somebody else. */
function staleOf<Data>(error: unknown, yours: (id: string) => Data): StaleObject<Data> | null {
  if (!(error instanceof ApiError) || error.status !== 409) return null;
  const { current } = error.problem;
  if (typeof current !== 'object' || current === null) return null;
  const theirs = current as ProjectObject<Data>;
  return new StaleObject(theirs, yours(theirs.id));
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
