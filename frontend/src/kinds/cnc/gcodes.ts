/** The commands of the dialect and the letters that each one takes (cnc.md, section 8). */
import { wordOf, type Block } from './line';

export const AXES = 'XYZABCPQUVW';
const LIMITS = [...'ZABCPQUVW'].flatMap((axis) => [`F${axis}`, `E${axis}`]);
/** Values that hold until another one is given (GC-12). */
export const RATES: readonly string[] = ['F', 'E', 'FF', 'EF', ...LIMITS, 'S'];

export type Group = 'motion' | 'spline' | 'mode' | 'range' | 'shift' | 'control';

export interface GCode {
  readonly code: number;
  readonly group: Group;
  /** A program of the usual decoder has it; others are known to the interpreter of newer versions only. */
  readonly supported: boolean;
  readonly letters: ReadonlySet<string>;
  /** Letters without which the command means nothing. */
  readonly needs: readonly string[];
  /** The table has no element for it (CNC-47). */
  readonly textOnly: boolean;
}

const AX = [...AXES];
const VEL = ['F', 'E', 'FF', 'EF', ...LIMITS];
const SWITCH = ['H', 'L', 'O'];
const PATH = [...AX, ...VEL, ...SWITCH, 'D', 'S'];

interface Row {
  letters?: readonly string[];
  needs?: readonly string[];
  extension?: true;
  table?: true;
}

const GROUPS: Readonly<Record<Group, Readonly<Record<number, Row>>>> = {
  motion: {
    0: { letters: [...AX, ...VEL, ...SWITCH, 'S'], table: true },
    1: { letters: PATH, table: true },
    2: { letters: [...PATH, 'R', 'I', 'J', 'K', 'T'], table: true },
    3: { letters: [...PATH, 'R', 'I', 'J', 'K', 'T'], table: true },
    6: { letters: [...PATH, 'I', 'J'], needs: ['I', 'J'] },
    8: { letters: [...PATH, 'I', 'J', 'K', 'R'], needs: ['I', 'J'], table: true },
    9: { letters: [...PATH, 'I', 'J', 'K', 'R'], needs: ['I', 'J'], table: true },
    31: { letters: [...AX, ...VEL, 'S', 'PROBE'], extension: true },
  },
  spline: {
    5: { letters: PATH, table: true },
    10: { letters: PATH, table: true },
  },
  mode: {
    15: {},
    16: { letters: ['I', 'J', 'K'] },
    17: {},
    18: {},
    19: {},
    90: { table: true },
    91: { table: true },
    98: { table: true },
    99: { table: true },
  },
  range: {
    38: { letters: ['L', 'D'], needs: ['L'] },
    39: { letters: ['L', 'D'], needs: ['L'] },
    40: { table: true },
    41: { letters: ['D'], needs: ['D'], table: true },
    42: { letters: ['D'], needs: ['D'], table: true },
    43: { letters: ['I', 'J', 'K'] },
    50: { table: true },
    51: { letters: ['D'], needs: ['D'], table: true },
    52: { letters: ['D'], needs: ['D'], table: true },
    60: { table: true },
    61: { table: true },
    70: { letters: ['L'], needs: ['L'] },
    71: { letters: ['L'], needs: ['L'] },
  },
  shift: {
    53: {},
    54: { letters: AX },
    55: { letters: AX },
    56: { letters: AX },
    92: { letters: [...AX, ...SWITCH], table: true },
  },
  control: {
    4: { letters: ['T'], needs: ['T'] },
    20: { letters: ['L', 'K'], needs: ['L'] },
    36: { letters: ['O', 'D'], needs: ['D'] },
    37: { letters: ['O', 'D'], needs: ['D'] },
    75: {},
  },
};

export const G_CODES: ReadonlyMap<number, GCode> = new Map(
  Object.entries(GROUPS)
    .flatMap(([group, rows]) =>
      Object.entries(rows).map(([code, row]): [number, GCode] => [
        Number(code),
        {
          code: Number(code),
          group: group as Group,
          supported: row.extension !== true,
          letters: new Set(row.letters),
          needs: row.needs ?? [],
          textOnly: row.table !== true,
        },
      ]),
    )
    .sort(([a], [b]) => a - b),
);

export const M_LETTERS: ReadonlySet<string> = new Set(['K', 'L', 'O']);

/** Moves along a path, so that coordinates without a command go on with it (GC-06). */
export function isTravel(code: number): boolean {
  const group = G_CODES.get(code)?.group;
  return group === 'motion' || group === 'spline';
}

/** What a block does: a G command, an M function, coordinates for the command before, or nothing but values. */
export type Act =
  | { readonly kind: 'g'; readonly code: number }
  | { readonly kind: 'travel'; readonly code: number }
  | { readonly kind: 'm' }
  | { readonly kind: 'values' }
  /** Its number is not known before run time. */
  | { readonly kind: 'unknown' };

/** Letters that make a block without a command an element of the path. */
const MOVES: ReadonlySet<string> = new Set([...AX, 'I', 'J', 'R', 'T']);

export function actOf(block: Block, travel: number | null): Act {
  const g = wordOf(block, 'G');
  if (g !== undefined) return g.value.kind === 'number' ? { kind: 'g', code: g.value.number } : { kind: 'unknown' };
  if (wordOf(block, 'M') !== undefined) return { kind: 'm' };
  if (block.words.some(({ address }) => MOVES.has(address)))
    return travel === null ? { kind: 'unknown' } : { kind: 'travel', code: travel };
  return { kind: 'values' };
}

/** The command of the path that a block carries out, or the mode that it sets; null for all others. */
export function codeOf(act: Act): number | null {
  return act.kind === 'g' || act.kind === 'travel' ? act.code : null;
}

/** The letters that are possible beside what a block does; null: any. */
export function lettersOf(act: Act): ReadonlySet<string> | null {
  if (act.kind === 'm') return M_LETTERS;
  const code = codeOf(act);
  return code === null ? null : (G_CODES.get(code)?.letters ?? null);
}
