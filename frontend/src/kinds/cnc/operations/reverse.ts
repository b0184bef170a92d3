/** The path in the other direction (cnc.md CNC-89): the same elements from their ends to their starts. */
import { appliedTo, type LinesEdit } from '../edits';
import { AXES, isTravel } from '../gcodes';
import { numberWord, valueOf, wordOf, type Block } from '../line';
import { namesAxis, openingOf, startState, type Position, type State } from '../state';
import { renumbered } from './renumber';
import { Refused, stepsOf, type Step } from './refusal';
import { wordsOf } from './transform';

/** What counts where a program gives no value; a velocity of 0 is none. */
export interface Defaults {
  readonly velocity: number;
  readonly acceleration: number;
  readonly deceleration: number;
}

const TURNED: Readonly<Record<number, number>> = { 2: 3, 3: 2, 8: 9, 9: 8, 41: 42, 42: 41 };

function turned(code: number): number {
  return TURNED[code] ?? code;
}

/** The whole program anew, in absolute coordinates of the machine, with block numbers 0, 10, 20 ... */
export function reversedProgram(lines: readonly string[], start: Position, defaults: Defaults): LinesEdit[] {
  const steps = stepsOf(lines, start, ['variables', 'orientation', 'suppression', 'jumps']);
  // The normal of a plane that is given freely would have to be kept along.
  const tilted = steps.find(({ code }) => code === 16);
  if (tilted !== undefined) throw new Refused('plane', tilted.line);
  const last = steps.at(-1);
  if (last === undefined || !steps.some(isElement)) return [];
  const writer = new Reversed(defaults);
  const header = lines.filter((text) => text.trimStart().startsWith('%'));
  writer.lines.push(...header, `G92 ${positionWords(last.after.position, start)}`);
  for (const step of [...steps].reverse()) writer.take(step);
  writer.end();
  const body = lines.at(-1) === '' ? [...writer.lines, ''] : writer.lines;
  return [{ from: 0, removed: lines.length, lines: appliedTo(body, renumbered(body)) }];
}

/** X and Y, and whatever other axis is not where it was. */
function positionWords(position: Position, before: Position): string {
  const axes = [...AXES].filter((_, axis) => axis < 2 || position[axis] !== before[axis]);
  return wordsOf(Object.fromEntries(axes.map((letter) => [letter, position[AXES.indexOf(letter)]!])));
}

function isElement({ block, code, state }: Step): boolean {
  if (code === null || !isTravel(code)) return false;
  return namesAxis(block) || wordOf(block, 'I') !== undefined || openingOf(block, state) !== undefined;
}

/** What of the modes counts for an element. */
type Modes = Pick<State, 'plane' | 'loops' | 'corner' | 'distance' | 'correction' | 'radius'>;

class Reversed {
  readonly lines: string[] = [];
  private modes: Modes = startState();
  private rates: State['rates'] = {};

  constructor(private readonly defaults: Defaults) {}

  take(step: Step): void {
    const { block, code, state, after } = step;
    const said = comments(block);
    if (isElement(step)) {
      this.enter({ ...state, correction: turned(state.correction) });
      const text = [`G${String(turned(code!))}`, ...elementWords(step), ...this.rateWords(step), ...switchWords(block)];
      this.lines.push([...text, ...said].join(' '));
      return;
    }
    if (code === 92) this.lines.push([`G92 ${positionWords(state.position, after.position)}`, ...said].join(' '));
    else if (code === 4 || code === 75 || wordOf(block, 'M')) this.lines.push(plainText(block));
    else this.lines.push(...said);
  }

  /** Behind the last element all ranges are closed. */
  end(): void {
    this.enter(startState());
  }

  private enter(wanted: Modes): void {
    const now = this.modes;
    const say = (code: number, d: number, takesD: boolean) =>
      this.lines.push(`G${String(code)}${takesD ? ` D${numberWord(d)}` : ''}`);
    if (wanted.plane !== now.plane) say(wanted.plane, 0, false);
    if (wanted.loops !== now.loops) say(wanted.loops, 0, false);
    if (wanted.corner !== now.corner || wanted.distance !== now.distance)
      say(wanted.corner, wanted.distance, wanted.corner !== 50);
    if (wanted.correction !== now.correction || wanted.radius !== now.radius)
      say(wanted.correction, wanted.radius, wanted.correction !== 40);
    this.modes = wanted;
  }

  /** F, E and the like of an element, where they are not in force already. */
  private rateWords({ line, after }: Step): string[] {
    const names = [...new Set([...Object.keys(this.rates), ...Object.keys(after.rates)])];
    const words = names.flatMap((name) => {
      const value = after.rates[name] ?? this.usual(name, line);
      if (this.rates[name] === value) return [];
      return [name === 'E-' ? `E-${numberWord(value)}` : name + numberWord(value)];
    });
    this.rates = Object.fromEntries(names.map((name) => [name, after.rates[name] ?? this.usual(name, line)]));
    return words;
  }

  private usual(name: string, line: number): number {
    const { velocity, acceleration, deceleration } = this.defaults;
    if (name === 'F' && velocity === 0) throw new Refused('unset', line, { letter: 'F' });
    return { F: velocity, E: acceleration, 'E-': deceleration }[name] ?? 0;
  }
}

function comments(block: Block): string[] {
  return block.tokens.filter(({ kind }) => kind === 'comment').map(({ at, end }) => block.text.slice(at, end));
}

/** The block without its number. */
function plainText(block: Block): string {
  return block.tokens
    .filter(
      (token) =>
        token.kind !== 'blank' &&
        !(token.kind === 'word' && block.text.slice(token.at, token.at + 1).toUpperCase() === 'N'),
    )
    .map(({ at, end }) => block.text.slice(at, end))
    .join(' ');
}

/** Target and shape of an element that is passed from its end. */
function elementWords(step: Step): string[] {
  const { block, state, after, code } = step;
  const opening = openingOf(block, state);
  const turns = opening !== undefined && Math.abs(opening) >= 360;
  const axes = [...AXES].filter(
    (_, axis) => (axis < 2 && !turns) || (axis >= 2 && state.position[axis] !== after.position[axis]),
  );
  const words = [wordsOf(Object.fromEntries(axes.map((letter) => [letter, state.position[AXES.indexOf(letter)]!])))];
  if (code === 2 || code === 3 || code === 6 || code === 8 || code === 9) {
    const spatial = state.plane !== 15 && (code === 2 || code === 3);
    const given = ['I', 'J', ...(spatial ? ['K'] : [])].some((letter) => wordOf(block, letter));
    const centres = given ? ['I', 'J', ...(spatial ? ['K'] : [])] : [];
    words.push(
      ...centres.map((letter, axis) => {
        const base = (state.centresAbsolute ? state.offset : state.position)[axis]!;
        return letter + numberWord(base + (valueOf(block, letter) ?? 0) - after.position[axis]!);
      }),
    );
    if (turns) words.push(`T${numberWord(opening)}`);
    const radius = valueOf(block, 'R');
    if (radius !== undefined) words.push(`R${numberWord(radius)}`);
    const direction = code === 8 || code === 9 ? valueOf(block, 'K') : undefined;
    if (direction !== undefined) words.push(`K${numberWord(direction)}`);
  }
  return words.filter((text) => text !== '');
}

/** Switch points lie where they lay: what switches on in one direction switches off in the other. */
function switchWords(block: Block): string[] {
  const words = block.words.filter(({ address }) => 'HLO'.includes(address) && address.length === 1);
  return words.flatMap(({ address, value }) => {
    if (value.kind !== 'number') return [];
    return [address + numberWord(address === 'O' ? 1 - value.number : -value.number)];
  });
}
