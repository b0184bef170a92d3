import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { LoadOfTasks } from '@/api/types';
import { joinedLoad } from './monitoring';

const EVERY_MS = 1000;
/** Samples that the runtime keeps: ten minutes. */
const MOST_SAMPLES = 600;

/** The load of tasks and processors, once a second while somebody looks; only what is new is asked for. */
export function useLoad(runtimeId: string | null) {
  const queryKey = [...keys.tasks(runtimeId ?? ''), 'load'];
  return useQuery({
    queryKey,
    queryFn: async () => {
      const known = queryClient.getQueryData<LoadOfTasks>(queryKey);
      const newest = Date.parse(known?.samples.at(-1)?.at ?? '');
      const fresh = await api.get('/api/v1/runtimes/{runtime_id}/tasks/load', {
        params: {
          path: { runtime_id: runtimeId ?? '' },
          query: { after_ms: Number.isNaN(newest) ? 0 : newest + 1 },
        },
      });
      return joinedLoad(known, fresh, MOST_SAMPLES);
    },
    enabled: runtimeId !== null,
    refetchInterval: EVERY_MS,
    retry: false,
  });
}
