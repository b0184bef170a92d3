/** What the debugger of each runtime does: breakpoints, halted tasks, and the level of a call stack that is looked at. */
import { create } from 'zustand';
import type { Breakpoint, CodeSpot, DebugState, FrameVariable, Halt, StackFrame } from '@/api/types';
import type { Part } from '@/project/partUri';

export interface Debugged {
  readonly state: DebugState;
  /** The halted task that is looked at. */
  readonly task: string | null;
  readonly frames: readonly StackFrame[];
  /** Index of the level that is looked at. */
  readonly frame: number;
  readonly variables: readonly FrameVariable[];
}

interface DebuggerState {
  readonly runtimes: Readonly<Record<string, Debugged>>;
}

export const useDebugger = create<DebuggerState>(() => ({ runtimes: {} }));

const NOTHING_HALTED = { task: null, frames: [], frame: 0, variables: [] } as const;

/** A new state of a runtime; what was looked at stays, while its task is halted. */
export function debugStateRead(runtimeId: string, state: DebugState): void {
  useDebugger.setState(({ runtimes }) => {
    const before = runtimes[runtimeId];
    const stays = before?.task != null && state.halted.some(({ task }) => task === before.task);
    return { runtimes: { ...runtimes, [runtimeId]: stays ? { ...before, state } : { ...NOTHING_HALTED, state } } };
  });
}

/** The call stack of a halted task. */
export function stackRead(runtimeId: string, task: string, frames: readonly StackFrame[]): void {
  change(runtimeId, { task, frames, frame: 0, variables: [] });
}

/** The variables of a level. */
export function variablesRead(runtimeId: string, frame: number, variables: readonly FrameVariable[]): void {
  change(runtimeId, { frame, variables });
}

export function debuggerGone(runtimeId: string): void {
  useDebugger.setState(({ runtimes }) => {
    const { [runtimeId]: _gone, ...others } = runtimes;
    return { runtimes: others };
  });
}

function change(runtimeId: string, values: Partial<Debugged>): void {
  useDebugger.setState(({ runtimes }) => {
    const before = runtimes[runtimeId];
    return before === undefined ? {} : { runtimes: { ...runtimes, [runtimeId]: { ...before, ...values } } };
  });
}

/** How a breakpoint looks beside its line. */
export type BreakpointLook = 'active' | 'conditional' | 'log' | 'disabled' | 'unverified';

export function lookOf({ order, verified }: Breakpoint): BreakpointLook {
  if (!order.enabled) return 'disabled';
  if (!verified) return 'unverified';
  if (order.log != null) return 'log';
  const limited = order.condition ?? order.instance ?? order.task;
  return limited != null || (order.hits?.mode ?? 'always') !== 'always' ? 'conditional' : 'active';
}

export interface LineOf {
  readonly objectId: string;
  readonly part: Part;
}

/** The line of a part at which a breakpoint stands: where the program can halt, or where it was set. */
export function breakpointLine({ actual, order }: Breakpoint, { objectId, part }: LineOf): number | null {
  const spot = actual ?? order.place;
  if (spot?.object_id !== objectId || (spot.part ?? 'implementation') !== part) return null;
  return spot.line ?? null;
}

/** The breakpoint of a line; one that was moved to the line counts, too. */
export function breakpointAt(breakpoints: readonly Breakpoint[], of: LineOf, line: number): Breakpoint | undefined {
  return breakpoints.find((one) => one.order.kind === 'line' && breakpointLine(one, of) === line);
}

/** The line of a part at which the task that is looked at stands, and whether it is the innermost level. */
export function currentLine(debugged: Debugged | undefined, of: LineOf): { line: number; innermost: boolean } | null {
  const shown = debugged?.frames[debugged.frame]?.place;
  if (shown?.object_id !== of.objectId || (shown.part ?? 'implementation') !== of.part) return null;
  return { line: shown.line, innermost: debugged?.frame === 0 };
}

/** The tasks that have halted since: what the debugger should show. */
export function newHalts(state: DebugState, before: DebugState | undefined): Halt[] {
  if (before?.sequence === state.sequence) return [];
  return state.halted.filter((halt) => {
    const known = before?.halted.find(({ task }) => task === halt.task);
    return known === undefined || !sameSpot(known.place, halt.place) || known.cycle !== halt.cycle;
  });
}

function sameSpot(a: CodeSpot, b: CodeSpot): boolean {
  return a.uri === b.uri && a.line === b.line && a.object_id === b.object_id && a.element === b.element;
}
