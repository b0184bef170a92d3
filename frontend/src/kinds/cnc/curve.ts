/** The curve of one element in the X/Y plane, and its length (cnc.md GEO-04 to GEO-09, GEO-13). */
import { pointOn, type Point } from './arc';
import { valueOf, wordOf, type Block } from './line';
import { arcOf, centreOf, xy, type State } from './state';

/** The point at a part of the parameter, 0 at the start and 1 at the end. */
export type Curve = (part: number) => Point;

const PIECES = 2048;

/** Null where the values make none (GEO-06, GEO-09), and for points of splines, which depend on their neighbours. */
export function curveOf(block: Block, state: State, after: State, code: number): Curve | null {
  const start = xy(state.position);
  const end = xy(after.position);
  switch (code) {
    case 0:
    case 1:
      return (part) => [start[0] + (end[0] - start[0]) * part, start[1] + (end[1] - start[1]) * part];
    case 2:
    case 3: {
      const arc = arcOf(block, state, code);
      return arc && ((part) => pointOn(arc, part));
    }
    case 6: {
      const vertex = centreOf(block, state);
      const control = [0, 1].map((axis) => 2 * vertex[axis]! - (start[axis]! + end[axis]!) / 2);
      const along = (part: number, axis: 0 | 1) =>
        (1 - part) ** 2 * start[axis] + 2 * part * (1 - part) * control[axis]! + part ** 2 * end[axis];
      return (part) => [along(part, 0), along(part, 1)];
    }
    case 8:
    case 9:
      return ellipseOf(block, state, end, code === 8);
    default:
      return null;
  }
}

function ellipseOf(block: Block, state: State, end: Point, clockwise: boolean): Curve | null {
  const centre = centreOf(block, state);
  const angle = ((valueOf(block, 'K') ?? 0) * Math.PI) / 180;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  /** Along the main axis and across it. */
  const local = ([x, y]: Point): Point => {
    const [dx, dy] = [x - centre[0], y - centre[1]];
    return [dx * cos + dy * sin, dy * cos - dx * sin];
  };
  const from = local(xy(state.position));
  const to = local(end);
  const axes = halfAxes(from, to, wordOf(block, 'R') && valueOf(block, 'R'));
  if (axes === null) return null;
  const [a, b] = axes;
  const begin = Math.atan2(from[1] / b, from[0] / a);
  let sweep = (Math.atan2(to[1] / b, to[0] / a) - begin) % (2 * Math.PI);
  if (clockwise && sweep >= -1e-12) sweep -= 2 * Math.PI;
  if (!clockwise && sweep <= 1e-12) sweep += 2 * Math.PI;
  return (part) => {
    const [u, w] = [a * Math.cos(begin + sweep * part), b * Math.sin(begin + sweep * part)];
    return [centre[0] + u * cos - w * sin, centre[1] + u * sin + w * cos];
  };
}

/** Of an ellipse through two points given from its centre; where both are as far from the main axis, by the ratio. */
function halfAxes([u1, w1]: Point, [u2, w2]: Point, ratio: number | undefined): Point | null {
  const across = w2 * w2 - w1 * w1;
  if (Math.abs(across) <= 1e-9 * Math.max(w1 * w1, w2 * w2, 1e-300)) {
    if (ratio === undefined || !(ratio > 0)) return null;
    const a = Math.hypot(u1, w1 / ratio);
    return a > 0 ? [a, a * ratio] : null;
  }
  // 1/a² and 1/b² of the two equations u²/a² + w²/b² = 1.
  const determinant = u1 * u1 * w2 * w2 - u2 * u2 * w1 * w1;
  const inverseA = (w2 * w2 - w1 * w1) / determinant;
  const inverseB = (u1 * u1 - u2 * u2) / determinant;
  return inverseA > 0 && inverseB > 0 ? [1 / Math.sqrt(inverseA), 1 / Math.sqrt(inverseB)] : null;
}

/** The length of a part of a curve by chords. */
export function lengthOf(curve: Curve, from = 0, to = 1): number {
  let length = 0;
  let last = curve(from);
  for (let piece = 1; piece <= PIECES; piece++) {
    const next = curve(from + ((to - from) * piece) / PIECES);
    length += Math.hypot(next[0] - last[0], next[1] - last[1]);
    last = next;
  }
  return length;
}
