/** What a word means in its block: keys of texts, for hovers, completions and the columns of the table. */
import { textOf } from '@/i18n';
import { actOf, AXES, codeOf, G_CODES, type Act } from './gcodes';
import { numberWord, wordOf, type Block, type Word } from './line';
import { openingOf, programmed, type State } from './state';

/** What a letter means beside a command, as the ending of a key `cnc.letter.…`. */
export function letterMeaning(address: string, act: Act, block: Block | null, state: State): string {
  const code = codeOf(act);
  const of = (...codes: number[]) => code !== null && codes.includes(code);
  if (address.length === 2 && address !== 'FF' && address !== 'EF')
    return address.startsWith('F') ? 'limitF' : 'limitE';
  if (AXES.includes(address)) {
    if (of(54, 56)) return 'shift';
    if (of(55)) return 'shiftMore';
    if (of(92)) return 'setTo';
    return state.relative ? 'distance' : 'target';
  }
  switch (address) {
    case 'D':
      return of(41, 42) ? 'toolRadius' : of(51, 52) ? 'cornerDistance' : of(36) ? 'written' : of(37) ? 'added' : 'D';
    case 'I':
    case 'J':
    case 'K':
      if (address === 'K') {
        if (act.kind === 'm') return 'parameter1';
        if (of(20)) return 'condition';
        if (of(8, 9)) return 'mainAxis';
        if (of(2, 3) && block !== null && openingOf(block, state) !== undefined && !wordOf(block, 'T')) return 'angle';
      }
      if (of(16)) return 'normal';
      if (of(43)) return 'toolOffset';
      if (of(6)) return state.centresAbsolute ? 'vertex' : 'vertexFrom';
      return state.centresAbsolute ? 'centre' : 'centreFrom';
    case 'L':
      return act.kind === 'm' ? 'parameter2' : of(20) ? 'jump' : of(70, 71) ? 'axisNumber' : 'switchDistance';
    case 'O':
      return act.kind === 'm' ? 'parameters' : of(36, 37) ? 'variable' : 'switchPart';
    case 'R':
      return of(8, 9) ? 'ratio' : 'radius';
    case 'T':
      return of(4) ? 'dwell' : 'angle';
    case 'E':
      return 'E';
    default:
      return address;
  }
}

/** A sentence about a command; undefined for a number that no command has. */
export function aboutCode(code: number): string | undefined {
  return G_CODES.has(code) ? (textOf(`cnc.code.G${String(code)}`) ?? undefined) : undefined;
}

export function aboutLetter(address: string, act: Act, block: Block | null, state: State): string | undefined {
  const key = `cnc.letter.${letterMeaning(address, act, block, state)}`;
  return textOf(key)?.replace('{{axis}}', address.length === 2 ? address.slice(1) : address);
}

/** What holds before a block, as a program would say it: `G1 G90 G99 F100`. */
export function inForce(state: State): string {
  const range = (code: number, off: number, d: number) =>
    code === off || code === 60 ? [] : [`G${String(code)}${code === 61 ? '' : ` D${numberWord(d)}`}`];
  const rate = ([name, value]: [string, number]) =>
    name === 'E-' ? `E-${numberWord(value)}` : name + numberWord(value);
  return [
    ...(state.travel === null ? [] : [`G${String(state.travel)}`]),
    state.relative ? 'G91' : 'G90',
    state.centresAbsolute ? 'G98' : 'G99',
    ...(state.plane === 15 ? [] : [`G${String(state.plane)}`]),
    ...range(state.correction, 40, state.radius),
    ...range(state.corner, 50, state.distance),
    ...range(state.loops, 60, 0),
    ...Object.entries(state.rates)
      .filter(([, value]) => Number.isFinite(value))
      .map(rate),
  ].join(' ');
}

/** Where the axes are before a block: X and Y, and others that have moved. */
export function positionText(state: State): string {
  return programmed(state)
    .map((value, axis) => ({ letter: AXES[axis]!, value }))
    .filter(({ value }, axis) => axis < 2 || value !== 0)
    .map(({ letter, value }) => letter + (Number.isFinite(value) ? numberWord(value) : '?'))
    .join(' ');
}

export interface Explained {
  readonly word: Word;
  readonly title: string;
  readonly about: string;
}

/** The word at a character of a block, in the words of the user. */
export function explained(block: Block, at: number, state: State): Explained | null {
  const word = block.words.find((one) => one.at <= at && at < one.end);
  if (word === undefined) return null;
  const act = actOf(block, state.travel);
  const title = block.text.slice(word.at, word.end);
  const about =
    word.address === 'G' && word.value.kind === 'number'
      ? aboutCode(word.value.number)
      : aboutLetter(word.address, act, block, state);
  return about === undefined ? null : { word, title, about };
}
