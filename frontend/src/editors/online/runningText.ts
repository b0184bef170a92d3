/**
 * The text of objects as the runtime executes it: taken while project and runtime are the same, kept while the user
 * goes on editing, so that values are shown at lines that run, not at lines that do not run yet.
 */
import { create } from 'zustand';
import { useOnline, type OnlineSession } from '@/workbench/onlineSession';

interface RunningTexts {
  /** By runtime, code and object. */
  texts: Readonly<Record<string, string>>;
}

const useRunningTexts = create<RunningTexts>(() => ({ texts: {} }));

const keyOf = (session: OnlineSession, objectId: string) =>
  `${session.runtimeId}/${session.runtime?.code_id ?? ''}/${objectId}`;

/** Remembers the stored text of an object as the running one, when it is. */
export function noteRunningText(session: OnlineSession, objectId: string, text: string): void {
  if (session.relation !== 'same' || session.runtime === null) return;
  const key = keyOf(session, objectId);
  if (useRunningTexts.getState().texts[key] !== undefined) return;
  useRunningTexts.setState(({ texts }) => ({ texts: { ...texts, [key]: text } }));
}

/** The running text of an object, or null when it is not known. */
export function runningText(session: OnlineSession, objectId: string): string | null {
  return useRunningTexts.getState().texts[keyOf(session, objectId)] ?? null;
}

useOnline.subscribe((state) => {
  if (Object.keys(state.sessions).length === 0) useRunningTexts.setState({ texts: {} });
});
