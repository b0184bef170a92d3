/** Scales of the graphs: ranges, ticks and snapping. Pure functions. */
import { acrossOf, clean, curvePath, downOf, niceStep, tickText, ticks, type Range } from '@/editors/plot/scales';
import type { CamTable } from './camTable';
import type { CamDrawing } from './curves';

export { acrossOf, downOf, niceStep, tickText, ticks, type Range };

/** What a graph shows over the master. */
export const GRAPHS = ['y', 'v', 'a', 'j'] as const;
export type GraphName = (typeof GRAPHS)[number];

/** Room above and below a curve that has no range of its own, as a part of its height. */
const MARGIN = 0.08;

/** What a dragged value moves in: a tenth of the distance of two ticks. */
export function snapStep(range: Range, count: number): number {
  return niceStep(range, count) / 10;
}

export function snapped(value: number, step: number): number {
  return clean(Math.round(value / step) * step, step);
}

/** The range of the master shown when it is zoomed by a factor about a place that stays where it is. */
export function zoomed(shown: Range, whole: Range, about: number, factor: number): Range {
  const width = Math.min(
    whole.max - whole.min,
    Math.max((whole.max - whole.min) * 1e-4, (shown.max - shown.min) * factor),
  );
  const part = (about - shown.min) / (shown.max - shown.min);
  return shifted({ min: about - part * width, max: about + (1 - part) * width }, whole, 0);
}

/** The range moved, within the whole one. */
export function shifted(shown: Range, whole: Range, by: number): Range {
  const width = Math.min(shown.max - shown.min, whole.max - whole.min);
  const min = Math.max(whole.min, Math.min(shown.min + by, whole.max - width));
  return { min, max: min + width };
}

/** The range of a graph: that of the slave's position from the properties, others by their values (CAM-33). */
export function valueRange(cam: CamTable, drawing: CamDrawing | null, graph: GraphName): Range {
  let min = Infinity;
  let max = -Infinity;
  const take = (value: number) => {
    if (value < min) min = value;
    if (value > max) max = value;
  };
  for (const segment of drawing?.segments ?? []) segment[graph].forEach(take);
  if (graph !== 'j') cam.points.forEach((point) => take(point[graph]));
  if (graph === 'y') {
    take(cam.slave_start);
    take(cam.slave_end);
  } else take(0);
  if (!Number.isFinite(min) || !Number.isFinite(max)) return { min: -1, max: 1 };
  if (max - min < 1e-12 * Math.max(1, Math.abs(max))) {
    const size = Math.max(1, Math.abs(max));
    return { min: min - size, max: max + size };
  }
  const room = MARGIN * (max - min);
  return { min: min - room, max: max + room };
}

/** A value of the drawn curve between two of its samples; null outside of the cam. */
export function valueOnCurve(drawing: CamDrawing, graph: GraphName, x: number): number | null {
  const curve = drawing.segments.find((one) => x <= one.x.at(-1)!);
  if (curve === undefined || x < curve.x[0]!) return null;
  const right = Math.max(
    1,
    curve.x.findIndex((at) => at >= x),
  );
  const [x0, x1] = [curve.x[right - 1]!, curve.x[right]!];
  const part = x1 > x0 ? (x - x0) / (x1 - x0) : 0;
  return curve[graph][right - 1]! * (1 - part) + curve[graph][right]! * part;
}

/** Pixels that the circle of a point needs. */
const POINT_ROOM = 7;

/**
 * The points of which there is room to draw circle and border: all of them, but where a plot has more points than it
 * can show apart, those that stand too near to a neighbour are left to the curve. `always` is drawn.
 */
export function drawnPoints(xs: readonly number[], window: Range, width: number, always: number | null): number[] {
  const inside = xs.map((_, index) => index).filter((index) => xs[index]! >= window.min && xs[index]! <= window.max);
  if (inside.length * POINT_ROOM <= width) return inside;
  const room = (POINT_ROOM / width) * (window.max - window.min);
  return inside.filter((index) => {
    const [left, right] = [xs[index - 1] ?? -Infinity, xs[index + 1] ?? Infinity];
    return index === always || Math.min(xs[index]! - left, right - xs[index]!) >= room;
  });
}

/** Pixels left of a plot, for the names of graphs and the numbers of values, and right of it. */
export const MARGIN_LEFT = 116;
export const MARGIN_RIGHT = 24;

/** A curve in a plot with the margin at its left, as the path of an SVG. */
export function pathOf(
  xs: readonly number[],
  curve: readonly number[],
  window: Range,
  values: Range,
  width: number,
  height: number,
): string {
  return curvePath(xs, curve, window, values, { left: MARGIN_LEFT, width, height });
}
