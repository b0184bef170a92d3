/** A curve of more points than pixels, as its extent in each column of pixels. Pure functions. */
import type { Curve, Curves } from '../data/curves';
import type { Plane } from './plane';

/** From top to bottom by column of pixels; NaN where nothing is drawn. */
export interface Columns {
  top: Float32Array;
  bottom: Float32Array;
}

/** Pixels up and down for each to the right: a line that goes so far is a surface rather than a line. */
const STEEP = 8;

/**
 * Whether there are more points than columns, and so steep that a line from point to point would show no more than
 * the columns; a smooth one is better drawn as a line.
 */
export function isDense(curves: Curves, curve: Curve, plane: Plane): boolean {
  const { time } = curves;
  if (time.length < 2) return false;
  const across = Math.abs(plane.toX(time[time.length - 1]!) - plane.toX(time[0]!));
  if (time.length <= across) return false;
  let travel = 0;
  for (let k = 1; k < time.length; k += 1) {
    const apart = Math.abs(curve.low[k]! - curve.low[k - 1]!) + curve.high[k]! - curve.low[k]!;
    if (apart > 0) travel += apart;
  }
  return travel * Math.abs(plane.toY(1) - plane.toY(0)) > STEEP * across;
}

/**
 * The least and the greatest place of each column, joined to the column before as lines between the points would be.
 * `base` is a place that every point reaches, too: that of zero for saw teeth.
 */
export function columnsOf(curves: Curves, curve: Curve, plane: Plane, base: number | null = null): Columns {
  const count = Math.max(0, Math.ceil(plane.width));
  const top = new Float32Array(count).fill(NaN);
  const bottom = new Float32Array(count).fill(NaN);
  const { time, gap } = curves;
  const [highest, lowest] = [plane.top - 2, plane.top + plane.height + 2];
  const within = (y: number) => Math.min(lowest, Math.max(highest, y));
  const cover = (column: number, from: number, to: number) => {
    if (column < 0 || column >= count) return;
    // The comparison with NaN is false: an empty column takes what comes.
    if (!(top[column]! <= from)) top[column] = from;
    if (!(bottom[column]! >= to)) bottom[column] = to;
  };
  let before: { column: number; from: number; to: number } | null = null;
  for (let k = 0; k < time.length; k += 1) {
    const low = curve.low[k]!;
    if (Number.isNaN(low)) {
      before = null;
      continue;
    }
    const column = Math.floor(plane.toX(time[k]!) - plane.left);
    const [one, other] = [within(plane.toY(low)), within(plane.toY(curve.high[k]!))];
    const from = base === null ? Math.min(one, other) : Math.min(one, other, base);
    const to = base === null ? Math.max(one, other) : Math.max(one, other, base);
    if (before !== null && gap[k] !== 1) join(before, { column, from, to }, cover);
    cover(column, from, to);
    before = { column, from, to };
  }
  return { top, bottom };
}

interface Span {
  column: number;
  from: number;
  to: number;
}

/** What lies between two points: the rest of a step within a column, a slope over the columns between them. */
function join(one: Span, other: Span, cover: (column: number, from: number, to: number) => void): void {
  const [start, end] =
    one.to < other.from ? [one.to, other.from] : other.to < one.from ? [one.from, other.to] : [one.to, one.to];
  const steps = Math.abs(other.column - one.column);
  if (steps <= 1) {
    if (start !== end) cover(other.column, Math.min(start, end), Math.max(start, end));
    return;
  }
  const sign = other.column > one.column ? 1 : -1;
  for (let step = 1; step <= steps; step += 1) {
    const [a, b] = [start + ((end - start) * (step - 1)) / steps, start + ((end - start) * step) / steps];
    cover(one.column + sign * step, Math.min(a, b), Math.max(a, b));
  }
}

/** Fills the columns of a band of the plane, `thick` pixels where the curve is flat; equal neighbours as one. */
export function fillColumns(
  context: Pick<CanvasRenderingContext2D, 'fillRect'>,
  { top, bottom }: Columns,
  left: number,
  band: { from: number; to: number },
  thick: number,
): void {
  let [begin, y, height] = [0, 0, 0];
  for (let column = 0; column <= top.length; column += 1) {
    const empty = column === top.length || Number.isNaN(top[column]!);
    const from = empty ? 0 : Math.round(top[column]! - thick / 2);
    const to = empty ? 0 : Math.max(from + thick, Math.round(bottom[column]! + thick / 2));
    const above = Math.max(band.from, from);
    const size = Math.max(0, Math.min(band.to, to) - above);
    if (above === y && size === height) continue;
    if (height > 0) context.fillRect(left + begin, y, column - begin, height);
    [begin, y, height] = [column, above, size];
  }
  if (height > 0) context.fillRect(left + begin, y, top.length - begin, height);
}
