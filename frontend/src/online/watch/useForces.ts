import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import type { Schemas } from '@/api/types';
import { expressionKey } from '../item';

export type ForcedVariable = Schemas['ForcedValue'];

/** The forced variables with where the forces come from; asked again whenever others are forced. */
export function useForces(runtimeId: string | null, paths: readonly string[]) {
  return useQuery({
    queryKey: ['runtimes', runtimeId, 'forces', paths],
    queryFn: async (): Promise<ReadonlyMap<string, ForcedVariable>> => {
      const { values } = await api.get('/api/v1/runtimes/{runtime_id}/forces', {
        params: { path: { runtime_id: runtimeId ?? '' } },
      });
      return new Map(values.map((value) => [expressionKey(value.expression), value]));
    },
    enabled: runtimeId !== null && paths.length > 0,
    refetchInterval: 2000,
    retry: false,
  });
}
