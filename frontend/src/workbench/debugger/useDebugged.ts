import { useActiveSession } from '../online/session';
import { useDebugger, type Debugged } from './state';

/** The debugger of the runtime that the active application is logged in to. */
export function useDebugged(): { runtimeId: string; debugged: Debugged | undefined } | null {
  const runtimeId = useActiveSession()?.runtimeId;
  const debugged = useDebugger(({ runtimes }) => (runtimeId === undefined ? undefined : runtimes[runtimeId]));
  return runtimeId === undefined ? null : { runtimeId, debugged };
}
