import { useQuery, type UseQueryResult } from '@tanstack/react-query';
import { useEffect } from 'react';
import { api } from '@/api/client';
import type { Schemas } from '@/api/types';
import type { Comparison, Ignoring } from './comparison';

/** The differences by now of an open comparison. */
export function useDifferences(
  projectId: string,
  opened: Comparison | undefined,
  ignoring: Ignoring,
): UseQueryResult<Comparison> {
  return useQuery({
    queryKey: ['comparison', projectId, opened?.id, ignoring],
    queryFn: () =>
      api.get('/api/v1/projects/{project_id}/comparisons/{comparison_id}', {
        params: {
          path: { project_id: projectId, comparison_id: opened!.id },
          query: {
            ignore_white_space: ignoring.white_space,
            ignore_comments: ignoring.comments,
            ignore_pragmas: ignoring.pragmas,
          },
        },
      }),
    enabled: opened !== undefined,
    staleTime: 0,
    gcTime: 0,
    placeholderData: (before) => before ?? opened,
  });
}

/** Both sides of an object. */
export function useSides(
  projectId: string,
  comparison: Comparison,
  key: string | null,
): UseQueryResult<Schemas['DifferenceDetail']> {
  const path = { project_id: projectId, comparison_id: comparison.id, key: key ?? '' };
  return useQuery({
    queryKey: ['comparison', projectId, comparison.id, 'sides', key, comparison.project_revision],
    queryFn: () =>
      api.get('/api/v1/projects/{project_id}/comparisons/{comparison_id}/objects/{key}', { params: { path } }),
    enabled: key !== null,
    staleTime: Infinity,
    gcTime: 0,
  });
}

/** Opens a comparison of revisions, and the next one when another is asked for; null asks for none. */
export function useRevisions(
  projectId: string,
  revisions: { old: number; now: number | null } | null,
): UseQueryResult<Comparison> {
  const query = useQuery({
    queryKey: ['comparison', projectId, 'open', revisions],
    queryFn: () =>
      api.post('/api/v1/projects/{project_id}/comparisons', {
        params: { path: { project_id: projectId } },
        body: {
          old: { kind: 'project', project_id: projectId, revision: revisions!.old },
          revision: revisions!.now,
        },
      }),
    enabled: revisions !== null,
    staleTime: Infinity,
    gcTime: 0,
  });
  useForgotten(projectId, query.data?.id);
  return query;
}

/** Tells the server when nobody looks at a comparison any more. */
export function useForgotten(projectId: string, id: string | undefined): void {
  useEffect(() => {
    if (id === undefined) return;
    return () => {
      const path = { project_id: projectId, comparison_id: id };
      // It may have gone by itself: the server keeps a few.
      api
        .delete('/api/v1/projects/{project_id}/comparisons/{comparison_id}', { params: { path } })
        .catch(() => undefined);
    };
  }, [projectId, id]);
}
