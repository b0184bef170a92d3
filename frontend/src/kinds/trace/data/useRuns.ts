/** The runs that an editor shows: what the controller records now, and stored recordings. */
import { queryOptions, useQuery } from '@tanstack/react-query';
import { useEffect, useMemo, useSyncExternalStore } from 'react';
import type { OnlineSession } from '@/workbench/onlineSession';
import type { TraceData } from '../configuration';
import { RunData, type RunShape } from './runData';
import {
  ask,
  RECORDINGS,
  sourcePath,
  tracesPath,
  withQuery,
  type Recording,
  type Recordings,
  type Source,
  type TraceState,
} from './source';

export const traceKeys = {
  state: (runtimeId: string, name: string) => ['trace', runtimeId, name] as const,
  recordings: (projectId: string) => ['recordings', projectId] as const,
};

const LIST_MS = 2000;

/** The traces that a controller has. */
export function tracesQuery(runtimeId: string) {
  return queryOptions({
    queryKey: ['traces', runtimeId] as const,
    queryFn: ({ signal }) => ask<TraceState[]>(tracesPath(runtimeId), signal),
    refetchInterval: LIST_MS,
    staleTime: 0,
    retry: false,
  });
}

/** How the trace runs in the controller; null where it does not, undefined as long as that is not known. */
export function useTraceState(session: OnlineSession | null, name: string, everyMs: number) {
  const runtimeId = session?.runtimeId ?? '';
  const codeId = session?.runtime?.code_id ?? null;
  return useQuery({
    queryKey: [...traceKeys.state(runtimeId, name), codeId],
    // From the list: that the controller does not have it is no failure.
    queryFn: async ({ signal }): Promise<TraceState | null> => {
      const all = await ask<TraceState[]>(tracesPath(runtimeId), signal);
      return all.find((one) => one.name.toLowerCase() === name.toLowerCase()) ?? null;
    },
    enabled: session !== null && session.lostSince === null && name !== '',
    refetchInterval: everyMs,
    staleTime: 0,
    gcTime: 0,
    retry: false,
  });
}

export function useRecordings(projectId: string) {
  return useQuery({
    queryKey: traceKeys.recordings(projectId),
    queryFn: ({ signal }) => ask<Recordings>(withQuery(RECORDINGS, { project_id: projectId }), signal),
    refetchInterval: (query) =>
      query.state.data?.recordings.some(({ state }) => state === 'recording') ? 2000 : false,
    staleTime: 0,
  });
}

export function recordingQuery(id: string) {
  return queryOptions({
    queryKey: ['recording', id] as const,
    queryFn: ({ signal }) => ask<Recording>(sourcePath({ kind: 'stored', id }), signal),
    staleTime: Infinity,
    retry: false,
  });
}

export function useRecording(id: string | null) {
  return useQuery({ ...recordingQuery(id ?? ''), enabled: id !== null });
}

/** The samples of a source while it is shown; another `key` is another run. */
function useRun(key: string | null, source: Source | null, shape: RunShape | null): RunData | null {
  const ready = source !== null && shape !== null;
  const run = useMemo(
    () => (key === null || source === null || shape === null ? null : new RunData(source, shape)),
    // The key says which run it is; source and shape of one key are the same.
    // eslint-disable-next-line react-hooks/exhaustive-deps
    [key, ready],
  );
  useEffect(() => {
    run?.open();
    return () => run?.close();
  }, [run]);
  useSyncExternalStore(run?.subscribe ?? noSubscription, run?.snapshot ?? zero);
  return run;
}
const noSubscription = () => () => undefined;
const zero = () => 0;

/** What the controller records now, and its configuration as it was downloaded. */
export function useRunning(session: OnlineSession | null, name: string, state: TraceState | null | undefined) {
  const runtimeId = session?.runtimeId ?? '';
  const key = state ? `${runtimeId} ${name} ${state.downloaded_at} ${state.data_digest}` : null;
  const { data: configuration } = useQuery({
    queryKey: ['trace-configuration', key],
    queryFn: ({ signal }) =>
      ask<{ data: TraceData }>(`${sourcePath({ kind: 'running', runtimeId, name })}/configuration`, signal),
    enabled: key !== null,
    staleTime: Infinity,
    retry: false,
  });
  const source = useMemo((): Source => ({ kind: 'running', runtimeId, name }), [runtimeId, name]);
  const records = state?.records;
  const shape = configuration && records ? { data: configuration.data, base: null, records } : null;
  const run = useRun(key, source, shape);
  const samples = state?.records.map((one) => `${one.samples}/${one.first}/${one.state}`).join(' ');
  useEffect(() => {
    void run?.refresh();
  }, [run, samples]);
  return run;
}

export function useStoredRun(recording: Recording | undefined): RunData | null {
  const source = useMemo((): Source | null => (recording ? { kind: 'stored', id: recording.id } : null), [recording]);
  const shape = useMemo(() => (recording ? storedShape(recording) : null), [recording]);
  return useRun(recording?.id ?? null, source, shape);
}

/** Times of a stored recording count from its first sample. */
export function storedShape(recording: Recording): RunShape {
  const firsts = recording.records.flatMap(({ first_ns }) => (first_ns === null ? [] : [BigInt(first_ns)]));
  const base = firsts.length === 0 ? null : firsts.reduce((one, other) => (other < one ? other : one));
  return { data: recording.data, base, records: recording.records };
}
