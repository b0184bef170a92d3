/** The run of a script: its worker, its requests and its output. One script runs at a time. */
import { create } from 'zustand';
import { shaped } from '@/api/objects';
import { keys, objectQuery, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { language, t } from '@/i18n';
import { ofRole } from '@/project/kinds';
import { useProject } from '@/project/openProject';
import { openDialog } from '@/ui/dialogs';
import { useSession } from '@/session/session';
import { commandContext } from '@/workbench/context';
import { saveEditors } from '@/workbench/docking/close';
import { showPanel } from '@/workbench/docking/dock';
import { createElement } from 'react';
import type { FromWorker, OutputLine, ScriptFacts, ScriptFailure, ToWorker } from './protocol';
import { refusalOf, ScriptClient } from './requests';
import { isTrusted, trust } from './trust';
import { TrustDialog } from './TrustDialog';

/** Lines that the panel keeps; what came before is left out. */
const MOST_LINES = 2000;

export interface Line extends OutputLine {
  /** Grows with each line, so that a line stays itself while others go. */
  serial: number;
  /** Line of the script that it is about. */
  at?: number;
}

export type RunState = 'running' | 'done' | 'failed' | 'stopped';

interface Run {
  projectId: string;
  objectId: string;
  name: string;
  state: RunState;
  lines: readonly Line[];
}

export const useScriptRun = create<{ run: Run | null }>(() => ({ run: null }));

let stopRunning: ((state: RunState) => void) | null = null;
let serial = 0;

export function scriptRuns(): boolean {
  return useScriptRun.getState().run?.state === 'running';
}

export function stopScript(): void {
  stopRunning?.('stopped');
}

export function clearOutput(): void {
  useScriptRun.setState(({ run }) => ({ run: run?.state === 'running' ? { ...run, lines: [] } : null }));
}

/** Runs a script as it is stored, after everything typed is; asks before the first run of a text. */
export async function runScript(projectId: string, objectId: string): Promise<void> {
  if (scriptRuns() || !(await saveEditors(commandContext().dirtyPanels))) return;
  const stored = await queryClient.fetchQuery({ ...objectQuery(projectId, objectId), staleTime: 0 });
  const script = shaped(stored, ofRole('script'));
  const { text } = script.data;
  if (!(await isTrusted(projectId, objectId, text))) {
    const agreed = await openDialog<true>((close) =>
      createElement(TrustDialog, { projectId, objectId, name: script.name, text, close }),
    );
    if (agreed !== true || scriptRuns()) return;
    await trust(text);
  }
  start({ projectId, objectId, name: script.name, state: 'running', lines: [] }, text);
}

function start(run: Run, text: string): void {
  const url = URL.createObjectURL(new Blob([text], { type: 'text/javascript' }));
  const worker = new Worker(new URL('./scriptWorker.ts', import.meta.url), { type: 'module', name: run.name });
  const client = new ScriptClient();
  const send = (message: ToWorker) => worker.postMessage(message);
  const end = (state: RunState) => {
    worker.terminate();
    client.end();
    URL.revokeObjectURL(url);
    stopRunning = null;
    useScriptRun.setState(({ run: now }) => ({ run: now && { ...now, state } }));
  };
  stopRunning = end;
  useScriptRun.setState({ run });
  showPanel('scripts', false);
  worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
    if (stopRunning !== end) return;
    switch (data.type) {
      case 'lines':
        add(data.lines);
        return;
      case 'request':
        void client.perform(data).then(
          (answer) => send({ type: 'answer', id: data.id, data: answer }),
          (error: unknown) => send({ type: 'refusal', id: data.id, ...refusalOf(error) }),
        );
        return;
      case 'stray':
        add([failureLine(data)]);
        return;
      case 'failed':
        add([failureLine(data)]);
        end('failed');
        return;
      case 'done':
        end('done');
    }
  };
  worker.onerror = (event) => {
    event.preventDefault();
    add([{ tone: 'error', text: event.message || t('scripts.noWorker') }]);
    end('failed');
  };
  send({ type: 'start', url, facts: factsOf(run.projectId) });
}

function add(lines: readonly (OutputLine & { at?: number })[]): void {
  const fresh = lines.map((line): Line => ({ ...line, serial: (serial += 1) }));
  useScriptRun.setState(({ run }) => ({ run: run && { ...run, lines: [...run.lines, ...fresh].slice(-MOST_LINES) } }));
}

function failureLine({ message, line }: ScriptFailure): OutputLine & { at?: number } {
  if (line === null) return { tone: 'error', text: message };
  return { tone: 'error', text: t('scripts.errorAt', { line, message }), at: line };
}

function factsOf(projectId: string): ScriptFacts {
  const { selection, applicationId } = commandContext();
  const user = useSession.getState().user;
  return {
    projectId,
    projectName: useProject.getState().projectName,
    applicationId,
    selection: selection.map(({ id, name, kind }) => ({ id, name, kind })),
    user: { name: user?.username ?? '', role: user?.role ?? '', language: language() },
  };
}

/** The scripts of a project by name. */
export function scriptsOf(projectId: string | null, isScript: (object: ObjectSummary) => boolean): ObjectSummary[] {
  const objects = (projectId && queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId))) || [];
  return objects.filter(isScript).sort((a, b) => a.name.localeCompare(b.name));
}
