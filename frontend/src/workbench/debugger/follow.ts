/** The debugger follows the runtimes that one is logged in to: it shows where a task halts. */
import { notifyError } from '@/ui/notices';
import { showPanel } from '../docking/dock';
import { isRecording, useOnline } from '../onlineSession';
import { refreshDebugger, showStack } from './acts';
import { switchFlow } from './flow';
import { debuggerGone, newHalts, useDebugger } from './state';

/** Sequence of the state that was asked for last, by runtime. */
const asked = new Map<string, number>();

export function followDebugger(): () => void {
  return useOnline.subscribe(({ sessions }) => {
    const runtimes = new Map(
      Object.values(sessions).flatMap(({ runtimeId, runtime }) =>
        runtime === null || isRecording(runtimeId) ? [] : [[runtimeId, runtime]],
      ),
    );
    for (const runtimeId of asked.keys())
      if (!runtimes.has(runtimeId)) {
        asked.delete(runtimeId);
        switchFlow(runtimeId, false);
        debuggerGone(runtimeId);
      }
    for (const [runtimeId, runtime] of runtimes)
      if (runtime.connected && asked.get(runtimeId) !== runtime.debug_sequence) {
        asked.set(runtimeId, runtime.debug_sequence);
        look(runtimeId).catch(notifyError);
      }
  });
}

async function look(runtimeId: string): Promise<void> {
  const before = useDebugger.getState().runtimes[runtimeId]?.state;
  await refreshDebugger(runtimeId);
  const now = useDebugger.getState().runtimes[runtimeId];
  if (now === undefined) return;
  const halt = newHalts(now.state, before)[0];
  if (halt === undefined && now.task !== null) return;
  const shown = halt ?? now.state.halted[0];
  if (shown === undefined) return;
  showPanel('callStack', false);
  await showStack(runtimeId, shown.task);
}
