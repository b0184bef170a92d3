/**
 * What becomes of a block whose end or tangent is dragged in the graphic (CNC-57). Arcs, ellipses and parabolas keep
 * their shape when their end moves: centre or vertex turn and grow with the chord.
 */
import { replaced, withValue } from '../edits';
import { actOf, codeOf, isTravel } from '../gcodes';
import { numberWord, readBlock, valueOf, wordOf, type Block } from '../line';
import { arcOf, centreOf, openingOf, programmed, stateAfter, xy, type State } from '../state';
import type { Vector } from './projection';

const AXES = ['X', 'Y', 'Z'] as const;
const ROUND = new Set([2, 3, 6, 8, 9]);
type Point = readonly [number, number];

/** A number that says no more than the picture shows; `grain`: how large a pixel is. */
export function rounded(value: number, grain: number): number {
  const step = 10 ** Math.floor(Math.log10(Math.max(grain, 1e-9)));
  return Number((Math.round(value / step) * step).toPrecision(15));
}

/** Whether the end of a block can be dragged, and where it is, in machine coordinates; null where it cannot. */
export function movableEnd(block: Block, state: State): Vector | null {
  const code = codeOf(actOf(block, state.travel));
  if (code === null || !isTravel(code)) return null;
  const { position } = stateAfter(block, state);
  const end: Vector = [position[0]!, position[1]!, position[2]!];
  if (end.some(Number.isNaN) || state.position.slice(0, 3).some(Number.isNaN)) return null;
  if (block.words.some(({ address, value }) => 'XYZIJKR'.includes(address) && value.kind !== 'number')) return null;
  if ((code === 2 || code === 3) && openingOf(block, state) !== undefined) return null;
  if (hasCentre(block) && ROUND.has(code)) {
    // The turn of the chord is one in X/Y; a full circle has no chord.
    if (state.plane !== 15 && state.plane !== 17) return null;
    if (end[0] === state.position[0] && end[1] === state.position[1]) return null;
  }
  return end;
}

function hasCentre(block: Block): boolean {
  return wordOf(block, 'I') !== undefined || wordOf(block, 'J') !== undefined;
}

/** The line with its end elsewhere (machine coordinates); null where it cannot be there. */
export function withEnd(block: Block, state: State, place: Vector): string | null {
  const before = movableEnd(block, state);
  if (before === null) return null;
  const base = state.relative ? state.position : state.offset;
  let { text } = block;
  AXES.forEach((letter, axis) => {
    const read = readBlock(text);
    const word = wordOf(read, letter);
    if (word === undefined && before[axis] === place[axis]) return;
    text = withValue(read, word, letter, numberWord(tidy(place[axis]! - base[axis]!)));
  });
  const code = codeOf(actOf(block, state.travel))!;
  if (!ROUND.has(code)) return text;
  if (hasCentre(block)) return withTurnedCentre(block, state, text, code, [before, place]);
  const radius = valueOf(block, 'R');
  if (radius === undefined || code > 3) return text;
  // The chord of an arc is at most its diameter.
  const least = Math.hypot(place[0] - state.position[0]!, place[1] - state.position[1]!) / 2;
  if (state.plane !== 15 && state.plane !== 17) return text;
  return radius >= least ? text : withNumber(text, 'R', least * (1 + 1e-9));
}

function withTurnedCentre(
  block: Block,
  state: State,
  text: string,
  code: number,
  [before, after]: readonly [Vector, Vector],
): string | null {
  const start = xy(state.position);
  const from: Point = [before[0] - start[0], before[1] - start[1]];
  const to: Point = [after[0] - start[0], after[1] - start[1]];
  const square = from[0] ** 2 + from[1] ** 2;
  if (to[0] === 0 && to[1] === 0) return null;
  // to / from as complex numbers.
  const turn: Point = [(to[0] * from[0] + to[1] * from[1]) / square, (to[1] * from[0] - to[0] * from[1]) / square];
  const centre = centreOf(block, state);
  const [x, y] = [centre[0] - start[0], centre[1] - start[1]];
  const next = withCentre(text, state, [start[0] + turn[0] * x - turn[1] * y, start[1] + turn[0] * y + turn[1] * x]);
  if (code < 8) return next;
  const degrees = (valueOf(block, 'K') ?? 0) + (Math.atan2(turn[1], turn[0]) * 180) / Math.PI;
  return withNumber(next, 'K', degrees);
}

function withCentre(text: string, state: State, centre: Point): string {
  const base = state.centresAbsolute ? programmedZero(state) : xy(state.position);
  return withNumber(withNumber(text, 'I', centre[0] - base[0]), 'J', centre[1] - base[1]);
}

/** What absolute centres count from. */
function programmedZero(state: State): Point {
  const here = programmed(state);
  return [state.position[0]! - here[0]!, state.position[1]! - here[1]!];
}

/** Differences of places have errors of rounding that nobody wrote. */
function tidy(value: number): number {
  return Number(value.toFixed(9));
}

function withNumber(text: string, letter: string, value: number): string {
  const block = readBlock(text);
  return withValue(block, wordOf(block, letter), letter, numberWord(tidy(value)));
}

/** Whether the tangents of a block can be dragged: those of arcs in X/Y. */
export function movableTangents(block: Block, state: State): boolean {
  const code = codeOf(actOf(block, state.travel));
  if ((code !== 2 && code !== 3) || (state.plane !== 15 && state.plane !== 17)) return false;
  const end = movableEnd(block, state);
  return end !== null && arcOf(block, state, code) !== null && chord(state, end) > 0;
}

function chord(state: State, end: Vector): number {
  return Math.hypot(end[0] - state.position[0]!, end[1] - state.position[1]!);
}

/** The line as the arc between the same ends that leaves its start, or arrives at its end, in a direction; null: none. */
export function withTangent(block: Block, state: State, at: 'start' | 'end', direction: Point): string | null {
  if (!movableTangents(block, state)) return null;
  const end = movableEnd(block, state)!;
  const start = xy(state.position);
  const way: Point = [end[0] - start[0], end[1] - start[1]];
  const size = Math.hypot(...direction);
  if (size === 0) return null;
  let [dx, dy] = [direction[0] / size, direction[1] / size];
  if (at === 'end') {
    // The tangents of an arc are mirrored at the bisector of its chord.
    const length = chord(state, end);
    const [ux, uy] = [way[0] / length, way[1] / length];
    const along = dx * ux + dy * uy;
    [dx, dy] = [2 * along * ux - dx, 2 * along * uy - dy];
  }
  // The centre lies on the normal of the tangent, left of it for an arc against the clock.
  const across = -dy * way[0] + dx * way[1];
  if (Math.abs(across) < 1e-6 * Math.hypot(...way)) return null;
  const radius = (way[0] ** 2 + way[1] ** 2) / (2 * across);
  const centre: Point = [start[0] - dy * radius, start[1] + dx * radius];
  const command = wordOf(block, 'G');
  const code = radius > 0 ? '3' : '2';
  const turned =
    command === undefined
      ? codeOf(actOf(block, state.travel)) === Number(code)
        ? block.text
        : null
      : replaced(block.text, command.valueAt, command.end, code);
  if (turned === null) return null;
  const free = readBlock(turned);
  return withCentre(withValue(free, wordOf(free, 'R'), 'R', null), state, centre);
}
