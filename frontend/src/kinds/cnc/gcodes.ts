/** The commands of the dialect and the letters that each one takes (cnc.md, section 8): the table of the compiler. */
import dialect from './dialect.json';
import { wordOf, type Block } from './line';

export const AXES = dialect.axes;
/** All addresses that a word may have. */
export const ADDRESSES: ReadonlySet<string> = new Set(dialect.addresses);
/** Values that hold until another one is given, and stand in any block (GC-12). */
export const MODAL: ReadonlySet<string> = new Set(dialect.modal);
/** Those of movements. */
export const RATES: readonly string[] = dialect.modal.filter((address) => address !== 'D');
/** Limits of axes that a path element has no place for. */
export const LIMITLESS: ReadonlySet<string> = new Set(dialect.limitless);
export const M_LETTERS: ReadonlySet<string> = new Set(dialect.functionLetters);
export const LAST_M = dialect.lastFunction;
/** Switch points of one element (H). */
export const MOST_SWITCHES = dialect.mostSwitches;

export interface GCode {
  readonly code: number;
  /** It stays for blocks without one (GC-06). */
  readonly travels: boolean;
  /** Those that are proposed; modal values stand in any block. */
  readonly letters: ReadonlySet<string>;
  /** Letters of which it needs one, where there are some. */
  readonly needs: readonly string[];
  /** The table has no element for it (CNC-47). */
  readonly textOnly: boolean;
  /** A block may have a word PROBE: its movement ends where a signal comes. */
  readonly probes: boolean;
  /** The first and the last number that L may be, where no others make sense. */
  readonly numbers: readonly number[] | null;
}

/** Commands with an element in the table (CNC-48). */
const IN_TABLE: ReadonlySet<number> = new Set([
  0, 1, 2, 3, 5, 8, 9, 10, 40, 41, 42, 50, 51, 52, 60, 61, 90, 91, 92, 98, 99,
]);

/** Modes that usually say a radius or distance with them. */
const SET_BY_D: ReadonlySet<number> = new Set([41, 42, 51, 52]);

export const G_CODES: ReadonlyMap<number, GCode> = new Map(
  Object.entries(dialect.commands)
    .map(([name, { letters, needs, travels, probes, numbers }]): [number, GCode] => {
      const code = Number(name);
      const possible = new Set([...letters, ...(travels ? MODAL : SET_BY_D.has(code) ? ['D'] : [])]);
      const textOnly = !IN_TABLE.has(code);
      return [code, { code, travels, letters: possible, needs, textOnly, probes, numbers }];
    })
    .sort(([a], [b]) => a - b),
);

/** Moves along a path, so that coordinates without a command go on with it (GC-06). */
export function isTravel(code: number): boolean {
  return G_CODES.get(code)?.travels === true;
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
const MOVES: ReadonlySet<string> = new Set([...AXES, 'I', 'J', 'R', 'T']);

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
