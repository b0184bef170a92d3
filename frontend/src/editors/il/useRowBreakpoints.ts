import { useMemo } from 'react';
import { guard } from '@/ui/notices';
import { breakpointLine, currentLine, lookOf, useDebugger, type BreakpointLook } from '@/workbench/debugger/state';
import type { OnlineSession } from '@/workbench/onlineSession';
import { toggleBreakpointAt } from '../online/breakpointActs';
import { rowAt, type IlRow } from './rows';

export interface RowBreakpoint {
  readonly look: BreakpointLook;
  /** Condition, log message, and why it does not hold. */
  readonly hint: string;
}

interface RowBreakpoints {
  readonly marks: ReadonlyMap<number, RowBreakpoint>;
  /** Row of the level of the call stack that is looked at. */
  readonly current: number | null;
  /** Whether the task stands there, or in something that is called there. */
  readonly innermost: boolean;
  /** Sets a breakpoint at a row or takes it away; null while logged out. */
  readonly toggle: ((row: number) => void) | null;
}

/** Breakpoints of the rows of a body, and where the task that is looked at stands in it. */
export function useRowBreakpoints(
  session: OnlineSession | null,
  objectId: string,
  rows: readonly IlRow[],
): RowBreakpoints {
  const runtimeId = session?.runtimeId ?? null;
  const debugged = useDebugger(({ runtimes }) => (runtimeId === null ? undefined : runtimes[runtimeId]));
  const marks = useMemo(() => {
    const found = new Map<number, RowBreakpoint>();
    for (const one of debugged?.state.breakpoints ?? []) {
      const line = breakpointLine(one, { objectId, part: 'implementation' });
      if (line === null || one.order.kind !== 'line') continue;
      const hint = [one.order.condition, one.order.log, one.reason].filter(Boolean).join('\n');
      found.set(rowAt(rows, line, Infinity), { look: lookOf(one), hint });
    }
    return found;
  }, [debugged, objectId, rows]);
  // Where a task stands now says nothing about a past cycle.
  const at = session?.past != null ? null : currentLine(debugged, { objectId, part: 'implementation' });
  const current = at === null ? null : rowAt(rows, at.line, Infinity);
  const toggle =
    runtimeId === null
      ? null
      : (row: number) => {
          const line = rows[row]?.line;
          const of = { objectId, part: 'implementation' } as const;
          if (line !== undefined) void guard(() => toggleBreakpointAt(runtimeId, of, line));
        };
  return { marks, current, innermost: at?.innermost ?? false, toggle };
}
