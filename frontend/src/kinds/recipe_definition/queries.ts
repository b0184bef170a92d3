import { keepPreviousData, useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';

/** The elementary variables of the application that fit a query, and the types of those of the definition as stored. */
export function useRecipeVariables(projectId: string, objectId: string, query: string, revision = 0) {
  return useQuery({
    queryKey: ['recipe-variables', projectId, objectId, query, revision],
    queryFn: () =>
      api.get('/api/v1/projects/{project_id}/recipes/{definition_id}/variables', {
        params: { path: { project_id: projectId, definition_id: objectId }, query: { query } },
      }),
    placeholderData: keepPreviousData,
    retry: false,
    gcTime: 0,
  });
}

/** All elementary variables of a structure, an array or an instance. */
export async function membersOf(projectId: string, objectId: string, below: string): Promise<readonly string[]> {
  const { found } = await api.get('/api/v1/projects/{project_id}/recipes/{definition_id}/variables', {
    params: { path: { project_id: projectId, definition_id: objectId }, query: { below } },
  });
  return found.map(({ path }) => path);
}

const LOOK_MS = 1000;

/** The variables of the definition beside their values in the controller; nothing while logged out. */
export function useComparison(runtimeId: string | null, projectId: string, objectId: string, revision: number) {
  return useQuery({
    queryKey: ['recipe-comparison', runtimeId, projectId, objectId, revision],
    queryFn: () =>
      api.post('/api/v1/runtimes/{runtime_id}/recipes/compare', {
        params: { path: { runtime_id: runtimeId ?? '' } },
        body: { project_id: projectId, definition_id: objectId },
      }),
    enabled: runtimeId !== null,
    placeholderData: keepPreviousData,
    refetchInterval: LOOK_MS,
    retry: false,
    gcTime: 0,
  });
}
