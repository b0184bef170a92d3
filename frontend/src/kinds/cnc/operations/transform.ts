/** Move, rotate and stretch a program (cnc.md CNC-86 to CNC-88): a linear map of its coordinates, word by word. */
import { lineEdit, replaced, withWord, type LinesEdit } from '../edits';
import { AXES, isTravel } from '../gcodes';
import { numberWord, readBlock, valueOf, wordOf, type Block } from '../line';
import { coordinatesOf, namesAxis, ORIGIN, programmed, type Position, type State } from '../state';
import { stepsOf, type Reason, type Step } from './refusal';

/** `linear` maps distances; a point is mapped the same and moved by `shift`. */
interface Map {
  readonly linear: (vector: Position) => Position;
  readonly shift: Position;
  /** X and Y go into each other: where one is given both are written. */
  readonly coupled: boolean;
  /** Of lengths. */
  readonly scale: number;
  /** Of directions in the plane, in degrees. */
  readonly turn: number;
  /** D of tool correction and corners is a length, too. */
  readonly distances: boolean;
}

type Values = Record<string, number>;

function pointOf(map: Map, point: Position): Position {
  return map.linear(point).map((value, axis) => value + map.shift[axis]!);
}

/** The words of the axes that a block names, and with X also Y where both go into each other. */
function axisWords(block: Block, mapped: Position, coupled: boolean): Values {
  const given = coordinatesOf(block);
  const plane = coupled && (given[0] !== undefined || given[1] !== undefined);
  const named = given.flatMap((value, axis) => (value !== undefined || (plane && axis < 2) ? [axis] : []));
  return Object.fromEntries(named.map((axis) => [AXES[axis]!, mapped[axis]!]));
}

/** The coordinates of a block, those of the state where it names none. */
function filled(block: Block, otherwise: Position): Position {
  return coordinatesOf(block).map((value, axis) => value ?? otherwise[axis]!);
}

function coordinates({ block, state, code }: Step, map: Map): Values {
  if (!namesAxis(block) || code === null) return {};
  const absolute = code === 92 || code === 56 || (isTravel(code) && !state.relative);
  if (absolute) return axisWords(block, pointOf(map, filled(block, programmed(state))), map.coupled);
  if (code === 54) return axisWords(block, map.linear(filled(block, state.offset)), map.coupled);
  if (code === 55 || isTravel(code)) return axisWords(block, map.linear(filled(block, ORIGIN)), map.coupled);
  return {};
}

/** I, J and K: centres, vertices, normals. */
function centres({ block, state, code }: Step, map: Map): Values {
  const given = ['I', 'J', 'K'].map((letter) => valueOf(block, letter));
  if (given.every((value) => value === undefined) || code === null) return {};
  if (![2, 3, 6, 8, 9, 16].includes(code)) return {};
  const vector = ORIGIN.map((_, axis) => (axis < 3 ? (given[axis] ?? 0) : 0));
  if (code === 16) {
    // A normal has a direction only: it is turned and not stretched.
    const [i, j] = map.linear(vector).map((value) => value / map.scale);
    return map.coupled ? { I: i!, J: j! } : {};
  }
  const mapped = state.centresAbsolute ? pointOf(map, vector) : map.linear(vector);
  const spatial = state.plane !== 15 && (code === 2 || code === 3);
  const both = map.coupled || state.centresAbsolute;
  return Object.fromEntries([
    ...['I', 'J'].flatMap((letter, axis) => (both || given[axis] !== undefined ? [[letter, mapped[axis]!]] : [])),
    ...(spatial && given[2] !== undefined ? [['K', mapped[2]!]] : []),
    ...((code === 8 || code === 9) && map.turn !== 0 ? [['K', (given[2] ?? 0) + map.turn]] : []),
  ]) as Values;
}

function lengths({ block, code }: Step, map: Map): Values {
  const found: Values = {};
  const radius = valueOf(block, 'R');
  if (radius !== undefined && (code === 2 || code === 3)) found['R'] = radius * map.scale;
  const distance = valueOf(block, 'D');
  if (distance !== undefined && map.distances && code !== 36 && code !== 37) found['D'] = distance * map.scale;
  return found;
}

/** The text of a block with other values; words that are not there are added. */
function withValues(block: Block, values: Values): string {
  let { text } = block;
  const near = (a: number, b: number) => Math.abs(a - b) <= 1e-9 * Math.max(1, Math.abs(b));
  for (const word of [...block.words].reverse()) {
    const value = values[word.address];
    const same = value === undefined || (word.value.kind === 'number' && near(word.value.number, value));
    if (!same) text = replaced(text, word.valueAt, word.end, numberWord(value));
  }
  for (const [address, value] of Object.entries(values))
    if (wordOf(block, address) === undefined) text = withWord(readBlock(text), address, numberWord(value));
  return text;
}

/** Switch points are at distances along the element. */
function withSwitches(text: string, step: Step, map: Map): string {
  if (map.scale === 1 || step.code === null || (!isTravel(step.code) && step.code !== 92)) return text;
  return readBlock(text)
    .words.filter(({ address }) => address === 'L')
    .reverse()
    .reduce(
      (now, { value, valueAt, end }) =>
        value.kind === 'number' ? replaced(now, valueAt, end, numberWord(value.number * map.scale)) : now,
      text,
    );
}

function mappedStep(step: Step, map: Map): string {
  const values = { ...coordinates(step, map), ...centres(step, map), ...lengths(step, map) };
  return withSwitches(withValues(step.block, values), step, map);
}

function edits(steps: readonly Step[], map: Map, first: { line: number; text: string } | null): LinesEdit[] {
  return steps.flatMap((step) => {
    const text = mappedStep(step, map);
    const index = step.line - 1;
    if (first?.line === index) return [{ from: index, removed: 1, lines: [first.text, text] }];
    return text === step.block.text ? [] : [lineEdit(index, text)];
  });
}

/** The first block of the path that moves. */
export function firstMove(steps: readonly Step[]): Step | undefined {
  return steps.find(({ block, code }) => code !== null && isTravel(code) && block.words.length > 1);
}

export function wordsOf(values: Values): string {
  return Object.entries(values)
    .map(([letter, value]) => letter + numberWord(value))
    .join(' ');
}

const KEPT: Omit<Map, 'linear' | 'shift'> = { coupled: false, scale: 1, turn: 0, distances: false };

/** The positioning to a place that is the start moved by a vector, in the mode that holds. */
export function positioning(state: State, vector: Position, velocity: string): string {
  const target = state.relative ? vector : programmed(state).map((value, axis) => value + vector[axis]!);
  const axes = [...AXES].filter((_, axis) => axis < 2 || vector[axis] !== 0);
  const values = Object.fromEntries(axes.map((letter) => [letter, target[AXES.indexOf(letter)]!]));
  return `G0 ${wordsOf(values)}${velocity}`;
}

/** F of a block where no other holds: without it nothing could move in front of the block. */
export function velocityFor({ block, state }: Step, standard: number): string {
  const own = valueOf(block, 'F');
  return standard > 0 || state.rates['F'] !== undefined || own === undefined ? '' : ` F${numberWord(own)}`;
}

/** CNC-86: adds a vector to all coordinates; the program begins with a positioning to the moved start. */
export function movedProgram(
  lines: readonly string[],
  start: Position,
  vector: Position,
  velocity: number,
): LinesEdit[] {
  const steps = stepsOf(lines, start, ['variables', 'orientation']);
  const map: Map = { ...KEPT, linear: (v) => v, shift: vector };
  const first = firstMove(steps);
  const text = first && positioning(first.state, vector, velocityFor(first, velocity));
  return edits(steps, map, first === undefined ? null : { line: first.line - 1, text: text! });
}

/** Where the program starts once its start is mapped, as a block to be put in front; null where it stays. */
function startBlock(steps: readonly Step[], start: Position, map: Map): { line: number; text: string } | null {
  const mapped = pointOf(map, start);
  const axes = [...AXES].filter((_, axis) => Math.abs(mapped[axis]! - start[axis]!) > 1e-12);
  const first = steps.find(({ block }) => block.words.length > 0);
  if (axes.length === 0 || first === undefined) return null;
  const values = Object.fromEntries(axes.map((letter) => [letter, mapped[AXES.indexOf(letter)]!]));
  return { line: first.line - 1, text: `G92 ${wordsOf(values)}` };
}

function linearProgram(lines: readonly string[], start: Position, map: Map, reasons: readonly Reason[]): LinesEdit[] {
  const steps = stepsOf(lines, start, reasons);
  return edits(steps, map, startBlock(steps, start, map));
}

/** CNC-87: rotates around Z through the origin, degrees counter-clockwise. */
export function rotatedProgram(lines: readonly string[], start: Position, degrees: number): LinesEdit[] {
  const quarter = degrees / 90;
  // Quarters without the rounding of pi.
  const [cos, sin] = Number.isInteger(quarter)
    ? [[1, 0, -1, 0][((quarter % 4) + 4) % 4]!, [0, 1, 0, -1][((quarter % 4) + 4) % 4]!]
    : [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  const linear = ([x, y, ...others]: Position) => [cos * x! - sin * y!, sin * x! + cos * y!, ...others];
  const map: Map = { ...KEPT, linear, shift: ORIGIN, coupled: true, turn: degrees };
  return linearProgram(lines, start, map, ['variables', 'plane', 'jumps']);
}

/** CNC-88: multiplies by a factor that is not 0; orientations A, B, C are angles and stay. */
export function stretchedProgram(
  lines: readonly string[],
  start: Position,
  factor: number,
  distances: boolean,
): LinesEdit[] {
  const linear = (vector: Position) => vector.map((value, axis) => (axis >= 3 && axis <= 5 ? value : value * factor));
  const map: Map = { ...KEPT, linear, shift: ORIGIN, scale: Math.abs(factor), distances };
  return linearProgram(lines, start, map, ['variables']);
}

/** The blocks of a program, moved: the part of an array that stands at a place. */
export function movedBlocks(steps: readonly Step[], vector: Position): string[] {
  const map: Map = { ...KEPT, linear: (v) => v, shift: vector };
  return steps.map((step) => mappedStep(step, map));
}
