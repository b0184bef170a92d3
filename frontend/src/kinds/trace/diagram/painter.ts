/** Draws curves in their graph types (TRC-42) with the colours of their limits (TRC-43 to TRC-46). */
import type { GraphType, Warning } from '../configuration';
import type { Curve, Curves } from '../data/curves';
import { columnsOf, fillColumns, isDense } from './columns';
import type { Plane } from './plane';

/** The part of `Path2D` that an outline needs. */
export interface Pen {
  moveTo: (x: number, y: number) => void;
  lineTo: (x: number, y: number) => void;
}

export interface CurveLook {
  color: string;
  graph: GraphType;
  minimum: Warning | null;
  maximum: Warning | null;
  /** Of the canvas pixels. */
  width: number;
  /** An older run, or one that is computed. */
  dashed?: boolean;
}

/** Half of a cross or a point. */
const MARK = 3;

/** The outline of a curve; a point of many samples is a line from its minimum to its maximum. */
export function outline(pen: Pen, curves: Curves, curve: Curve, graph: GraphType, plane: Plane, mark = MARK): void {
  if (graph === 'none') return;
  if (graph === 'points' || graph === 'cross') {
    marks(pen, curves, curve, graph, plane, mark);
    return;
  }
  const { time, gap } = curves;
  let y: number | null = null;
  let x = 0;
  const zero = plane.toY(0);
  for (let k = 0; k < time.length; k += 1) {
    const low = curve.low[k]!;
    if (Number.isNaN(low)) {
      y = null;
      continue;
    }
    const at = plane.toX(time[k]!);
    const first = plane.toY(low);
    const last = low === curve.high[k] ? first : plane.toY(curve.high[k]!);
    if (y === null || gap[k] === 1) {
      pen.moveTo(at, first);
      // A sample alone would not be seen.
      if (first === last) pen.lineTo(at + 0.5, first);
    } else if (graph === 'step') {
      pen.lineTo(at, y);
      pen.lineTo(at, first);
    } else if (graph === 'saw_tooth') {
      pen.lineTo(at, zero);
      pen.moveTo(at, zero);
      pen.lineTo(at, first);
    } else if (first !== last && Math.abs(last - y) < Math.abs(first - y)) {
      // From the nearer end, so that a steep curve is no zigzag.
      pen.lineTo(at, last);
      pen.lineTo(at, first);
      y = first;
      x = at;
      continue;
    } else pen.lineTo(at, first);
    if (first !== last) pen.lineTo(at, last);
    y = last;
    x = at;
  }
  if (y !== null && graph === 'step') pen.lineTo(x, y);
}

function marks(pen: Pen, curves: Curves, curve: Curve, graph: GraphType, plane: Plane, size: number): void {
  for (let k = 0; k < curves.time.length; k += 1) {
    const [low, high] = [curve.low[k]!, curve.high[k]!];
    if (Number.isNaN(low)) continue;
    const x = plane.toX(curves.time[k]!);
    for (const value of low === high ? [low] : [low, high]) {
      const y = plane.toY(value);
      if (graph === 'cross') {
        pen.moveTo(x - size, y - size);
        pen.lineTo(x + size, y + size);
        pen.moveTo(x - size, y + size);
        pen.lineTo(x + size, y - size);
      } else {
        pen.moveTo(x - size / 2, y);
        pen.lineTo(x + size / 2, y);
      }
    }
  }
}

/** Parts of the plane from top to bottom, each with its colour: beyond a limit that of the warning (trace EX-06). */
export function bands(look: CurveLook, plane: Plane): { from: number; to: number; color: string }[] {
  const bottom = plane.top + plane.height;
  const limit = (warning: Warning) => Math.min(bottom, Math.max(plane.top, plane.toY(warning.limit)));
  const up = plane.toY(1) <= plane.toY(0);
  const marked = [
    { warning: look.maximum, above: up },
    { warning: look.minimum, above: !up },
  ].filter((one): one is { warning: Warning; above: boolean } => one.warning?.on === true);
  let [from, to] = [plane.top, bottom];
  const found: { from: number; to: number; color: string }[] = [];
  for (const { warning, above } of marked) {
    const at = limit(warning);
    if (above) {
      found.push({ from: plane.top, to: at, color: warning.color });
      from = Math.max(from, at);
    } else {
      found.push({ from: at, to: bottom, color: warning.color });
      to = Math.min(to, at);
    }
  }
  return [...found, { from, to, color: look.color }].filter((band) => band.to > band.from);
}

/**
 * Of more points a line is a pixel thick, which a browser without a graphics card draws forty times as fast as a
 * thicker one; where there are more device pixels there is a graphics card.
 */
const MANY = 150;
const widthOf = (points: number, width: number) => (points > MANY && width < 2 ? Math.min(1, width) : width);

/** Of a dashed curve where its dashes could not be told apart. */
const FAINT = 0.55;

/** Draws one curve, within the plane. */
export function paintCurve(
  context: CanvasRenderingContext2D,
  curves: Curves,
  curve: Curve,
  look: CurveLook,
  plane: Plane,
): void {
  const joined = look.graph === 'line' || look.graph === 'step' || look.graph === 'saw_tooth';
  if (joined && isDense(curves, curve, plane)) {
    const columns = columnsOf(curves, curve, plane, look.graph === 'saw_tooth' ? plane.toY(0) : null);
    context.save();
    if (look.dashed) context.globalAlpha = FAINT;
    for (const band of bands(look, plane)) {
      context.fillStyle = band.color;
      fillColumns(context, columns, plane.left, band, Math.max(1, Math.round(look.width)));
    }
    context.restore();
    return;
  }
  const path = new Path2D();
  outline(path, curves, curve, look.graph, plane, MARK * look.width);
  for (const { from, to, color } of bands(look, plane)) {
    context.save();
    context.beginPath();
    context.rect(plane.left, from, plane.width, to - from);
    context.clip();
    context.strokeStyle = color;
    context.lineWidth = look.graph === 'points' ? MARK * look.width : widthOf(curves.time.length, look.width);
    context.lineJoin = 'round';
    if (look.dashed) context.setLineDash([5 * look.width, 3 * look.width]);
    context.stroke(path);
    context.restore();
  }
}
