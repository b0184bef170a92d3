/** What may stand at a place of a block: commands, letters that the command takes, variables (CNC-34). */
import { actOf, AXES, G_CODES, lettersOf, M_LETTERS } from './gcodes';
import { aboutCode, aboutLetter } from './meaning';
import type { Block } from './line';
import type { State } from './state';

export interface Proposal {
  readonly label: string;
  readonly insert: string;
  readonly about: string;
  readonly kind: 'command' | 'letter' | 'variable';
}

const LETTERS = [...AXES, 'I', 'J', 'K', 'R', 'T', 'F', 'E', 'D', 'S', 'H', 'L', 'O'];

/** Where a word that is being typed begins, and what is offered; `variables` are known names. */
export function proposalsAt(
  block: Block,
  at: number,
  state: State,
  variables: readonly string[],
): { start: number; proposals: Proposal[] } {
  const before = block.text.slice(0, at);
  const token = block.tokens.find((one) => one.at < at && at <= one.end);
  if (token?.kind === 'comment' || token?.kind === 'header' || token?.kind === 'statement')
    return { start: at, proposals: [] };
  const variable = /\$[\w.]*$/.exec(before);
  if (variable !== null && isOpen(before)) {
    const proposals = variables.map((name): Proposal => ({
      label: `$${name}$`,
      insert: `$${name}$`,
      about: '',
      kind: 'variable',
    }));
    return { start: at - variable[0].length, proposals };
  }
  const start = at - (/[A-Za-z]{0,2}\d*$/.exec(before)?.[0].length ?? 0);
  const act = actOf(withoutWordAt(block, start), state.travel);
  const used = new Set(block.words.filter((word) => word.at !== start).map(({ address }) => address));
  return { start, proposals: [...commandsFor(used), ...lettersFor(used, act, block, state)] };
}

/** An odd number of dollar signs: the last one opens a name. */
function isOpen(before: string): boolean {
  return (before.split('$').length - 1) % 2 === 1;
}

/** The block as it is beside the word that is being typed. */
function withoutWordAt(block: Block, start: number): Block {
  return { ...block, words: block.words.filter((word) => word.at !== start) };
}

function commandsFor(used: ReadonlySet<string>): Proposal[] {
  if (used.has('G') || used.has('M')) return [];
  const codes = [...G_CODES.values()];
  return codes.map(({ code, needs }) => ({
    label: `G${String(code)}`,
    insert: `G${String(code)}${needs.length > 0 ? ' ' : ''}`,
    about: aboutCode(code) ?? '',
    kind: 'command',
  }));
}

function lettersFor(used: ReadonlySet<string>, act: ReturnType<typeof actOf>, block: Block, state: State): Proposal[] {
  const taken = lettersOf(act);
  const possible = taken === null ? LETTERS : LETTERS.filter((letter) => taken.has(letter));
  const letters = act.kind === 'unknown' || act.kind === 'values' ? LETTERS : possible;
  const again = act.kind === 'm' ? M_LETTERS : new Set(['E', 'H', 'L', 'O']);
  return letters
    .filter((letter) => !used.has(letter) || (again.has(letter) && act.kind !== 'm'))
    .map((letter) => ({
      label: letter,
      insert: letter,
      about: aboutLetter(letter, act, block, state) ?? '',
      kind: 'letter',
    }));
}
