/** Which part of a diagram is seen: zoom and scroll, and the way back through them (TRC-76 to TRC-79). Pure functions. */
import type { Range } from '@/editors/plot/scales';

/** What was zoomed or scrolled; null and what is missing follow the rules of the appearance. */
export interface View {
  /** Time in nanoseconds, one for all diagrams. */
  x: Range | null;
  /** Values, by diagram. */
  y: Readonly<Record<string, Range>>;
}

/** Views gone through: the newest of `past` is the one before `now`. */
export interface Views {
  past: readonly View[];
  now: View;
  future: readonly View[];
}

export const WHOLE_VIEW: View = { x: null, y: {} };
export const FIRST_VIEWS: Views = { past: [], now: WHOLE_VIEW, future: [] };
const MOST_KEPT = 100;
/** Below this the digits of a double end. */
const LEAST_PART = 1e-12;

/** Shows another view; the present one can be come back to. */
export function shown(views: Views, view: View): Views {
  return { past: [...views.past, views.now].slice(-MOST_KEPT), now: view, future: [] };
}

/** Shows another view in place of the present one: what belongs to one drag or one turn of the wheel is one step. */
export function replaced(views: Views, view: View): Views {
  return { ...views, now: view, future: [] };
}

export function back({ past, now, future }: Views): Views {
  const before = past.at(-1);
  return before === undefined
    ? { past, now, future }
    : { past: past.slice(0, -1), now: before, future: [now, ...future] };
}

export function forward({ past, now, future }: Views): Views {
  const [next, ...rest] = future;
  return next === undefined ? { past, now, future } : { past: [...past, now], now: next, future: rest };
}

/** The range seen after a zoom by `factor` (below 1 shows less) that leaves `at` where it is. */
export function zoomed(range: Range, at: number, factor: number, least = 0): Range {
  const span = (range.max - range.min) * factor;
  if (span < Math.max(least, LEAST_PART * Math.max(Math.abs(range.min), Math.abs(range.max)))) return range;
  if (!Number.isFinite(span)) return range;
  const part = (at - range.min) / (range.max - range.min);
  return { min: at - part * span, max: at + (1 - part) * span };
}

/** The range seen after scrolling by a part of it. */
export function scrolled(range: Range, part: number): Range {
  const by = (range.max - range.min) * part;
  return { min: range.min + by, max: range.max + by };
}

/** Half as much is seen (stretch), or twice as much (compress), around the middle. */
export function stretched(range: Range): Range {
  return zoomed(range, (range.min + range.max) / 2, 0.5);
}
export function compressed(range: Range): Range {
  return zoomed(range, (range.min + range.max) / 2, 2);
}

/** A range that has a size, and room around what it is of. */
export function withRoom(range: Range | null, part = 0.06): Range {
  if (range === null || !Number.isFinite(range.min) || !Number.isFinite(range.max)) return { min: 0, max: 1 };
  const span = range.max - range.min;
  const size = Math.max(Math.abs(range.min), Math.abs(range.max));
  const room = span > 1e-9 * size ? span * part : size > 0 ? size * 0.5 : 1;
  return { min: range.min - room, max: range.max + room };
}

/** The smallest range around all; null where there is none. */
export function around(ranges: readonly (Range | null)[]): Range | null {
  const some = ranges.filter((one) => one !== null);
  if (some.length === 0) return null;
  return {
    min: Math.min(...some.map((one) => one.min)),
    max: Math.max(...some.map((one) => one.max)),
  };
}
