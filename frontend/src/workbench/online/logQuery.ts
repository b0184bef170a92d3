/** The log of a runtime as it grows: each answer brings the lines since the last one. */
import { queryOptions } from '@tanstack/react-query';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { LogEntry } from '@/api/types';
import { language } from '@/i18n';
import { merged } from './log';

const POLL_MS = 2000;

/**
 * `connectedSince` names the connection. A runtime that was started again counts its lines from 1: after a
 * reconnection the log is read from its beginning, since lines with smaller numbers would never be asked for. So it is
 * in another language, in which the server says all lines.
 */
export function logQuery(runtimeId: string, connectedSince: string | null) {
  const queryKey = [...keys.log(runtimeId), connectedSince, language()] as const;
  return queryOptions({
    queryKey,
    queryFn: async () => {
      const known = queryClient.getQueryData<LogEntry[]>(queryKey) ?? [];
      const params = { path: { runtime_id: runtimeId }, query: { since: known.at(-1)?.id ?? 0 } };
      return merged(known, await api.get('/api/v1/runtimes/{runtime_id}/log', { params }));
    },
    placeholderData: (before: LogEntry[] | undefined) => before,
    refetchInterval: POLL_MS,
    retry: false,
  });
}
