/** Acts of the debugger on a line of a text. */
import { addBreakpoint, changeBreakpoint, control, removeBreakpoint } from '@/workbench/debugger/acts';
import { editBreakpoint } from '@/workbench/debugger/BreakpointDialog';
import { breakpointAt, useDebugger, type LineOf } from '@/workbench/debugger/state';

function known(runtimeId: string, of: LineOf, line: number) {
  return breakpointAt(useDebugger.getState().runtimes[runtimeId]?.state.breakpoints ?? [], of, line);
}

const spot = ({ objectId, part }: LineOf, line: number) => ({ object_id: objectId, part, line });

/** Sets a breakpoint at a line, or takes it away. */
export async function toggleBreakpointAt(runtimeId: string, of: LineOf, line: number): Promise<void> {
  const found = known(runtimeId, of, line);
  if (found !== undefined) await removeBreakpoint(runtimeId, found.id);
  else await addBreakpoint(runtimeId, { kind: 'line', place: spot(of, line) });
}

/** Keeps a breakpoint but lets tasks pass, or the other way round. */
export async function enableBreakpointAt(runtimeId: string, of: LineOf, line: number): Promise<void> {
  const found = known(runtimeId, of, line);
  if (found === undefined) return;
  await changeBreakpoint(runtimeId, found.id, { ...found.order, enabled: !(found.order.enabled ?? true) });
}

/** Asks what the breakpoint of a line is to do; it is set where there is none. */
export async function editBreakpointAt(runtimeId: string, of: LineOf, line: number): Promise<void> {
  const found = known(runtimeId, of, line) ?? (await addBreakpoint(runtimeId, { kind: 'line', place: spot(of, line) }));
  await editBreakpoint(runtimeId, found);
}

export const runToLine = (runtimeId: string, of: LineOf, line: number): Promise<void> =>
  control(runtimeId, 'run_to', spot(of, line));

export const setNextStatement = (runtimeId: string, of: LineOf, line: number): Promise<void> =>
  control(runtimeId, 'next_statement', spot(of, line));
