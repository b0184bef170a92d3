/** What is asked of the controller and of the store of recordings for one trace (TRC-70 to TRC-74, TRC-90, TRC-91). */
import { ApiError, requestBytes, sendFile } from '@/api/client';
import { queryClient } from '@/api/queries';
import { t } from '@/i18n';
import { guard, notify } from '@/ui/notices';
import { saveBlob } from '@/workbench/downloadFile';
import type { TraceData } from './configuration';
import {
  act,
  ask,
  RECORDINGS,
  sourcePath,
  withQuery,
  type DownloadProblem,
  type Recording,
  type Source,
} from './data/source';
import { traceKeys } from './data/useRuns';

export type ExportFormat = 'csv' | 'parquet' | 'trace';

/** A long-term recording; null: without that limit. */
export interface LongTermOrder {
  title: string;
  seconds: number | null;
  keep_seconds: number | null;
  keep_mib: number | null;
}

export interface TraceOnline {
  download: () => Promise<void>;
  tell: (what: 'start' | 'stop' | 'reset-trigger') => Promise<void>;
  configuration: () => Promise<TraceData>;
  snapshot: () => Promise<void>;
  beginRecording: (order: LongTermOrder) => Promise<void>;
  /** Of what is stored now. */
  title: () => string;
  endRecording: () => Promise<void>;
  save: (format: ExportFormat, record: number, formulas?: boolean) => Promise<void>;
  load: () => void;
}

interface Of {
  projectId: string;
  name: string;
  runtimeId: string | null;
  /** Whose samples are saved. */
  shown: Source | null;
  data: TraceData;
  onProblems: (problems: readonly DownloadProblem[]) => void;
  onShown: (recording: string) => void;
}

export function traceOnline(of: Of): TraceOnline {
  const { projectId, name, runtimeId, shown, data, onProblems, onShown } = of;
  const running = sourcePath({ kind: 'running', runtimeId: runtimeId ?? '', name });
  const look = () => queryClient.invalidateQueries({ queryKey: traceKeys.state(runtimeId ?? '', name) });
  const lookAtRecordings = () => queryClient.invalidateQueries({ queryKey: traceKeys.recordings(projectId) });
  const title = () => `${name} ${new Date().toLocaleString()}`;
  const upload = async (file: File) => {
    const path = withQuery(RECORDINGS, { project_id: projectId, title: file.name.replace(/\.trace$/i, '') });
    const loaded = (await sendFile(path, file)) as Recording;
    await lookAtRecordings();
    onShown(loaded.id);
  };
  return {
    download: async () => {
      onProblems([]);
      try {
        await act('put', running, { data, start: true, project_id: projectId });
      } catch (error) {
        const problems = problemsOf(error);
        if (problems === null) throw error;
        onProblems(problems);
      }
      await look();
    },
    tell: async (what) => {
      await act('post', `${running}/${what}`);
      await look();
    },
    configuration: async () => (await ask<{ data: TraceData }>(`${running}/configuration`)).data,
    snapshot: async () => {
      const { title: stored } = await act<Recording>('post', `${running}/snapshot`, {
        title: title(),
        project_id: projectId,
      });
      notify({ tone: 'ok', title: t('trace.stored', { title: stored }) });
      await lookAtRecordings();
    },
    title,
    beginRecording: async (order) => {
      await act('post', `${running}/recording`, { ...order, project_id: projectId });
      await Promise.all([look(), lookAtRecordings()]);
    },
    endRecording: async () => {
      const { title: stored } = await act<Recording>('delete', `${running}/recording`);
      notify({ tone: 'ok', title: t('trace.stored', { title: stored }) });
      await Promise.all([look(), lookAtRecordings()]);
    },
    save: async (format, record, formulas = true) => {
      if (shown === null) return;
      const path = withQuery(`${sourcePath(shown)}/export`, { format, record, formulas: String(formulas) });
      saveBlob(new Blob([await requestBytes(path, new AbortController().signal)]), `${name}.${format}`);
    },
    load: () => chooseFile('.trace', (file) => void guard(() => upload(file))),
  };
}

/** What hinders a download, by its places; null where something else went wrong. */
function problemsOf(error: unknown): DownloadProblem[] | null {
  if (!(error instanceof ApiError)) return null;
  const { problems } = error.problem;
  return Array.isArray(problems) ? (problems as DownloadProblem[]) : null;
}

/** Asks for a file of the user's computer. */
function chooseFile(accept: string, take: (file: File) => void): void {
  const input = document.createElement('input');
  input.type = 'file';
  input.accept = accept;
  input.addEventListener('change', () => {
    const file = input.files?.[0];
    if (file) take(file);
  });
  input.click();
}
