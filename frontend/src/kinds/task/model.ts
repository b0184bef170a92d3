/** A task's settings: what may be entered, how times are read and shown (tasks.md, sections 2 and 3). Pure functions. */
import { timeLiteral } from '@/iec/duration';
import { SOFT_PLC, SOFT_PLC_EXTERNAL_EVENTS } from '@/iec/softPlc';
import { valuesOf } from '@/project/kinds';
import type { ObjectSummary, TaskData, TaskPou } from '@/api/types';
import type { TextKey } from '@/i18n';
import { applicationOf } from '@/project/tree';

export type IntervalUnit = 'ms' | 'us';

const NS_OF: Readonly<Record<IntervalUnit, number>> = { ms: 1e6, us: 1e3 };

/** The unit that a stored interval is shown with: a bare number counts microseconds. */
export function unitOf(interval: string): IntervalUnit {
  return /^\d+$/.test(interval.trim()) ? 'us' : 'ms';
}

/**
 * What is stored for an entry (TASK-17): a number of ms becomes a TIME literal, one of µs stays a number,
 * a TIME literal stays as it is. Null when the entry is no time.
 */
export function intervalFrom(entry: string, unit: IntervalUnit): string | null {
  const text = entry.trim();
  if (/^\d+$/.test(text)) return unit === 'ms' ? `t#${Number(text)}ms` : String(Number(text));
  if (unit === 'ms' && /^\d+\.\d+$/.test(text)) return `t#${text}ms`;
  return timeLiteral(text) === null ? null : text;
}

/** A stored interval as a number of the unit that stands beside it; what is no whole or decimal number of it as it is. */
export function shownInterval(interval: string, unit: IntervalUnit): string {
  const ns = intervalNs(interval);
  if (ns === null || ns % 1000 !== 0) return interval;
  return String(ns / NS_OF[unit]);
}

/** Nanoseconds of a stored interval; null when it is none. */
export function intervalNs(interval: string): number | null {
  return /^\d+$/.test(interval.trim()) ? Number(interval) * 1000 : timeLiteral(interval);
}

export type TaskFaults = Partial<
  Record<'priority' | 'interval' | 'event' | 'watchdogTime' | 'watchdogPercent' | 'sensitivity', TextKey>
>;

/** What is wrong with the settings, field by field; empty when they can be stored. */
export function taskFaults(task: TaskData): TaskFaults {
  const faults: TaskFaults = {};
  const whole = (value: number, low: number, high: number) => Number.isInteger(value) && value >= low && value <= high;
  if (!whole(task.priority, SOFT_PLC.highestPriority, SOFT_PLC.lowestPriority)) faults.priority = 'task.priorityFault';
  if (task.type === 'cyclic') {
    const interval = intervalNs(task.interval);
    if (interval === null) faults.interval = 'task.timeFault';
    else if (interval <= 0) faults.interval = 'task.intervalFault';
  }
  if ((task.type === 'event' || task.type === 'status') && task.event.trim() === '') faults.event = 'task.eventFault';
  if (task.type === 'external' && externalEvent(task.event) === null) faults.event = 'task.externalFault';
  if (task.watchdog.enabled) {
    const time = intervalNs(task.watchdog.time);
    if (task.type === 'cyclic' && task.watchdog.percent !== null) {
      if (!whole(task.watchdog.percent, 1, SOFT_PLC.mostPercent)) faults.watchdogPercent = 'task.percentFault';
    } else if (time === null || time <= 0) faults.watchdogTime = 'task.timeFault';
    if (!whole(task.watchdog.sensitivity, 0, SOFT_PLC.mostSensitivity)) faults.sensitivity = 'task.sensitivityFault';
  }
  return faults;
}

/** Faults that the server would refuse; a missing event variable is reported by the compiler and may be saved meanwhile. */
export function canStore(task: TaskData): boolean {
  const { event: _later, ...faults } = taskFaults(task);
  return Object.keys(faults).length === 0;
}

/** The external event of this name (TASK-16); null where the controller has none. */
export function externalEvent(name: string): (typeof SOFT_PLC_EXTERNAL_EVENTS)[number] | null {
  return SOFT_PLC_EXTERNAL_EVENTS.find((event) => sameName(event, name.trim())) ?? null;
}

/** Stands for no group: a choice of a list needs a value. */
export const NO_GROUP = ' ';

/** Whether two names are the same in programs. */
export const sameName = (a: string, b: string): boolean => a.toUpperCase() === b.toUpperCase();

/** The list with one program moved up (-1) or down (+1); the same list when it is at the end already. */
export function movedPou(pous: readonly TaskPou[], at: number, by: -1 | 1): TaskPou[] {
  const to = at + by;
  const next = [...pous];
  if (at < 0 || at >= pous.length || to < 0 || to >= pous.length) return next;
  [next[at], next[to]] = [next[to]!, next[at]!];
  return next;
}

/** Programs that a task of this application can call: its own first, then those of the POUs view (TASK-22). */
export function callablePrograms(objects: readonly ObjectSummary[], taskId: string): ObjectSummary[] {
  const application = applicationOf(objects, taskId)?.id;
  const programs = objects.filter((object) => valuesOf(object) === 'program');
  const own = programs.filter((program) => applicationOf(objects, program.id)?.id === application);
  const names = new Set(own.map((program) => program.name.toUpperCase()));
  const shared = programs.filter(
    (program) => !applicationOf(objects, program.id) && !names.has(program.name.toUpperCase()),
  );
  const byName = (a: ObjectSummary, b: ObjectSummary) => a.name.localeCompare(b.name);
  return [...own.sort(byName), ...shared.sort(byName)];
}
