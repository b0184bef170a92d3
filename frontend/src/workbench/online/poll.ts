/** What is read again and again while logged in: the runtime's state and its tasks, for frame and status bar. */
import { useQuery, type UseQueryResult } from '@tanstack/react-query';
import { useEffect } from 'react';
import { api, ApiError } from '@/api/client';
import { keys, runtimeQuery } from '@/api/queries';
import type { TaskState } from '@/api/types';
import { connectionLost, isRecording, runtimePolled } from '../onlineSession';

const STATE_MS = 2000;
const TASKS_MS = 1000;
/** How often values of variables come where nothing else is asked for. */
export const MONITORING_MS = 100;

/** Follows a runtime's state; the online socket is quicker, this also works without it. */
export function useRuntimeState(runtimeId: string | null): void {
  const { data, error, dataUpdatedAt } = useQuery({
    ...runtimeQuery(runtimeId ?? ''),
    enabled: runtimeId !== null,
    refetchInterval: STATE_MS,
    retry: false,
  });
  useEffect(() => {
    if (runtimeId && data) runtimePolled(runtimeId, data);
  }, [runtimeId, data, dataUpdatedAt]);
  useEffect(() => {
    if (runtimeId && error instanceof ApiError && error.status === 0) connectionLost(runtimeId);
  }, [runtimeId, error]);
}

/** Statistics of the tasks while somebody looks: once a second, or as often as values come (TASK-58). */
export function useTasks(runtimeId: string | null, everyMs = TASKS_MS): UseQueryResult<TaskState[]> {
  const path = { runtime_id: runtimeId ?? '' };
  return useQuery({
    queryKey: [...keys.tasks(runtimeId ?? ''), everyMs],
    queryFn: () => api.get('/api/v1/runtimes/{runtime_id}/tasks', { params: { path } }),
    enabled: runtimeId !== null && !isRecording(runtimeId),
    refetchInterval: everyMs,
    retry: false,
  });
}
