/** The past cycles that a flight recorder keeps, and where one is among them. Pure functions. */
import type { PastMoment } from '@/workbench/onlineSession';

/** The end of one cycle. */
export interface Moment {
  readonly cycle: number;
  /** Milliseconds since 1970, with their fractions. */
  readonly at: number;
}

/** Microseconds count where cycles are short; a Date has none. */
export function momentOf(row: { cycle: number; timestamp: string }): Moment {
  const whole = Date.parse(row.timestamp);
  const digits = /\.(\d+)/.exec(row.timestamp)?.[1] ?? '';
  const fraction = digits.length > 3 ? Number(`0.${digits.slice(3)}`) : 0;
  return { cycle: row.cycle, at: whole + fraction };
}

/** The index reached by `delta` cycles from `at`; null is the present, behind the last one. */
export function stepped(count: number, at: number | null, delta: number): number | null {
  if (count === 0) return null;
  return Math.min(Math.max((at ?? count) + delta, 0), count - 1);
}

/** The last index whose cycle had ended at `time`; the first one where none had. */
export function indexAt(moments: readonly Moment[], time: number): number {
  let low = 0;
  let high = moments.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (moments[middle]!.at <= time) low = middle + 1;
    else high = middle;
  }
  return Math.max(low - 1, 0);
}

/** What views say of the moment; null of one that is not there. */
export function pastMoment(moments: readonly Moment[], index: number | null, fault: boolean): PastMoment | null {
  const moment = index === null ? undefined : moments[index];
  if (moment === undefined) return null;
  return { cycle: moment.cycle, at: moment.at, before: moments.at(-1)!.at - moment.at, fault };
}

/** Places of a slider where times are written: round spans before the end, at most `most` of them. */
export function ticksOf(moments: readonly Moment[], most: number): { index: number; before: number }[] {
  const first = moments[0];
  const last = moments.at(-1);
  if (first === undefined || last === undefined || last.at <= first.at || most < 1) return [];
  const span = last.at - first.at;
  let step = 10 ** Math.floor(Math.log10(span / most));
  for (const factor of [1, 2, 5, 10]) {
    if (span / (step * factor) <= most) {
      step *= factor;
      break;
    }
  }
  const ticks: { index: number; before: number }[] = [];
  for (let number = 0; number * step <= span * (1 + 1e-9) && ticks.length <= most; number += 1) {
    const before = number * step;
    ticks.push({ index: indexAt(moments, last.at - before + 1e-6), before });
  }
  return ticks;
}
