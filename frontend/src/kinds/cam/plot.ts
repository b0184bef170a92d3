/** Scales of the graphs: ranges, ticks and snapping. Pure functions. */
import type { CamDrawing } from './curves';
import type { CamTable } from './camTable';

export interface Range {
  min: number;
  max: number;
}

/** What a graph shows over the master. */
export const GRAPHS = ['y', 'v', 'a', 'j'] as const;
export type GraphName = (typeof GRAPHS)[number];

/** Room above and below a curve that has no range of its own, as a part of its height. */
const MARGIN = 0.08;

/** The step of a scale: 1, 2 or 5 times a power of ten, so that about `count` of them fill the range. */
export function niceStep(range: Range, count: number): number {
  const rough = (range.max - range.min) / Math.max(1, count);
  if (!(rough > 0) || !Number.isFinite(rough)) return 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  const part = rough / power;
  return (part <= 1 ? 1 : part <= 2 ? 2 : part <= 5 ? 5 : 10) * power;
}

/** The multiples of the step within a range. */
export function ticks(range: Range, count: number): number[] {
  const step = niceStep(range, count);
  const first = Math.ceil(range.min / step - 1e-9);
  const last = Math.floor(range.max / step + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, at) => clean((first + at) * step, step));
}

/** A tick with as many decimals as its step needs. */
export function tickText(value: number, step: number): string {
  if (value === 0) return '0';
  const size = Math.max(Math.abs(value), step);
  if (size >= 1e6 || step < 1e-5) return value.toExponential(2).replace(/\.?0+e/, 'e');
  return value.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}

/** A multiple of `step` without the rest that binary fractions leave. */
function clean(value: number, step: number): number {
  const decimals = Math.max(0, Math.min(15, 2 - Math.floor(Math.log10(step))));
  return Number(value.toFixed(decimals)) + 0;
}

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

/** Pixels between the left edge of a plot and a place. */
export function acrossOf(x: number, window: Range, width: number): number {
  return ((x - window.min) / (window.max - window.min)) * width;
}

/** Pixels between the upper edge of a plot and a value. */
export function downOf(value: number, values: Range, height: number): number {
  return ((values.max - value) / (values.max - values.min)) * height;
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
  return xs
    .map((x, at) => {
      const [left, top] = [MARGIN_LEFT + acrossOf(x, window, width), downOf(curve[at]!, values, height)];
      return `${at === 0 ? 'M' : 'L'}${left.toFixed(2)} ${top.toFixed(2)}`;
    })
    .join('');
}
