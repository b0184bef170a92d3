/** Splits an element at its middle into two of the same type (cnc.md CNC-90). */
import { curveOf, lengthOf, type Curve } from '../curve';
import type { LinesEdit } from '../edits';
import { AXES } from '../gcodes';
import { commentOf, numberWord, valueOf, wordOf, type Block } from '../line';
import { openingOf, type Position } from '../state';
import { Refused, stepsOf, type Step } from './refusal';

/** Words that say the same of both halves, or hold on from the first. */
const TWICE = ['R', 'K'];

/** `line` from 0. Throws `Refused` where the line has no element that has a middle. */
export function splitElement(lines: readonly string[], start: Position, line: number): LinesEdit[] {
  const steps = stepsOf(lines.slice(0, line + 1), start, ['variables', 'jumps']);
  const step = steps[line];
  if (step?.code == null || ![0, 1, 2, 3, 5, 6, 8, 9, 10].includes(step.code)) throw new Refused('element', line + 1);
  if (step.code === 5 || step.code === 10) throw new Refused('spline', line + 1);
  if (step.state.plane !== 15 && step.code !== 0 && step.code !== 1) throw new Refused('plane', line + 1);
  const curve = curveOf(step.block, step.state, step.after, step.code);
  if (curve === null) throw new Refused('shape', line + 1);
  const [first, second] = halves(step, curve);
  return [{ from: line, removed: 1, lines: [first, second] }];
}

function halves(step: Step, curve: Curve): [string, string] {
  const { block, state, after, code } = step;
  const opening = openingOf(block, state);
  const middle = between(state.position, after.position, curve);
  const firstText = bare(block);
  const command = `G${String(code)}`;
  const number = block.number === null ? '' : `N${String(block.number)} `;
  const own = (from: Position, to: Position, vertex: number) =>
    [
      ...(opening === undefined || Math.abs(opening) < 360
        ? axisWords(block, step, from, to)
        : otherAxes(block, step, from, to)),
      ...shapeWords(step, from, curve, vertex),
    ].join(' ');
  const length = switchLengths(curve);
  const [early, late] = switches(block, length);
  const rest = (texts: readonly string[]) => texts.filter((text) => text !== '').join(' ');
  const first = rest([`${number}${command}`, own(state.position, middle, 0.25), firstText, early]);
  const second = rest([command, own(middle, after.position, 0.75), late, comment(block)]);
  return [block.skip ? `/${first}` : first, block.skip ? `/${second}` : second];
}

/** Modal words of the block: they stand in the first half and hold in the second. */
function bare(block: Block): string {
  return block.words
    .filter(({ address }) => /^[FE]|^[DS]$/.test(address))
    .map(({ at, end }) => block.text.slice(at, end))
    .join(' ');
}

function comment(block: Block): string {
  const text = commentOf(block);
  return text === '' ? '' : `(${text})`;
}

function between(from: Position, to: Position, curve: Curve): Position {
  const [x, y] = curve(0.5);
  return from.map((value, axis) => (axis === 0 ? x : axis === 1 ? y : (value + to[axis]!) / 2));
}

/** The target of a half as the block would give it: absolute or relative, for the axes that it moves. */
function axisWords(block: Block, { state, after }: Step, from: Position, to: Position, least = 0): string[] {
  return [...AXES].flatMap((letter, axis) => {
    if (axis < least) return [];
    const moves = state.position[axis] !== after.position[axis] || (axis < 2 && from[axis] !== to[axis]);
    if (wordOf(block, letter) === undefined && !moves) return [];
    return [letter + numberWord(state.relative ? to[axis]! - from[axis]! : to[axis]! - state.offset[axis]!)];
  });
}

function otherAxes(block: Block, step: Step, from: Position, to: Position): string[] {
  return axisWords(block, step, from, to, 2);
}

/** R, centre, vertex and angle of a half. */
function shapeWords(step: Step, from: Position, curve: Curve, vertexAt: number): string[] {
  const { block, state, code } = step;
  if (code === 0 || code === 1) return [];
  const opening = openingOf(block, state);
  const centred = code === 6 || wordOf(block, 'I') !== undefined || wordOf(block, 'J') !== undefined;
  const base = state.centresAbsolute ? state.offset : from;
  const centre = code === 6 ? curve(vertexAt) : programmedCentre(step);
  const words = centred ? [`I${numberWord(centre[0] - base[0]!)}`, `J${numberWord(centre[1] - base[1]!)}`] : [];
  if (opening !== undefined) return Math.abs(opening) < 360 ? words : [...words, `T${numberWord(opening / 2)}`];
  const kept = TWICE.filter((letter) => valueOf(block, letter) !== undefined && code !== 6);
  return [...words, ...kept.map((letter) => letter + numberWord(valueOf(block, letter)!))];
}

function programmedCentre({ block, state }: Step): [number, number] {
  const base = state.centresAbsolute ? state.offset : state.position;
  return [base[0]! + (valueOf(block, 'I') ?? 0), base[1]! + (valueOf(block, 'J') ?? 0)];
}

interface Lengths {
  readonly first: number;
  readonly whole: number;
}

function switchLengths(curve: Curve): Lengths {
  const first = lengthOf(curve, 0, 0.5);
  return { first, whole: first + lengthOf(curve, 0.5, 1) };
}

/** Switch points go to the half that they are on. */
function switches(block: Block, { first, whole }: Lengths): [string, string] {
  const early: string[] = [];
  const late: string[] = [];
  const words = block.words.filter(({ address }) => 'HLO'.includes(address) && address.length === 1);
  words.forEach(({ address, value }, at) => {
    const place = words[at + 1];
    if (address !== 'H' || value.kind !== 'number' || place?.value.kind !== 'number') return;
    const given = place.value.number;
    const distance = place.address === 'O' ? given * whole : given < 0 ? whole + given : given;
    const inFirst = distance <= first;
    const half = inFirst ? first : whole - first;
    const rest = inFirst ? distance : distance - first;
    const said =
      place.address === 'O'
        ? `O${numberWord(half > 0 ? rest / half : 0)}`
        : `L${numberWord(given < 0 ? rest - half : rest)}`;
    (inFirst ? early : late).push(`H${String(value.number)} ${said}`);
  });
  return [early.join(' '), late.join(' ')];
}
