/** Blocks as rows of a table: what a cell shows, and the line that a changed cell makes (cnc.md CNC-40 to CNC-48). */
import { numberText, typedNumber } from '@/editors/form/numbers';
import type { TextKey } from '@/i18n';
import type { Schemas } from '@/api/types';
import { cutOut, lineEdit, replaced, withValue, withWord, type LinesEdit } from './edits';
import { actOf, AXES, codeOf, G_CODES, lettersOf, type Act } from './gcodes';
import { commentOf, isBlockNumber, readBlock, wordOf, type Block, type Word } from './line';
import { programmed, type State } from './state';

export type Column = Schemas['TableColumn']['name'];

/** The types that a row can be made: commands that the table has elements for (CNC-48), and M functions. */
export const ROW_TYPES: readonly string[] = [
  ...[...G_CODES.values()].filter(({ textOnly }) => !textOnly).map(({ code }) => `G${String(code)}`),
  'M',
];

const LETTERS: Readonly<Partial<Record<Column, string>>> = { n: 'N', acceleration: 'E', deceleration: 'E' };

export function letterOf(column: Column): string {
  return LETTERS[column] ?? column.toUpperCase();
}

export interface Row {
  readonly block: Block;
  readonly state: State;
  readonly act: Act;
  /** The table cannot change it (CNC-47). */
  readonly textOnly: boolean;
}

export function rowOf(block: Block, state: State): Row {
  const act = actOf(block, state.travel);
  const code = codeOf(act);
  const odd = block.tokens.some(({ kind }) => kind === 'header' || kind === 'statement' || kind === 'skip');
  const unknown = block.words.some(({ value }) => value.kind === 'variable' || value.kind === 'expression');
  return { block, state, act, textOnly: odd || unknown || (code !== null && G_CODES.get(code)?.textOnly !== false) };
}

/** What the row is called: `G1`, `M7`, or the key of a text. */
export function typeOf({ block, act, textOnly }: Row): { text: string } | { key: TextKey } {
  const code = codeOf(act);
  if (code !== null) return { text: `G${String(code)}` };
  const m = wordOf(block, 'M')?.value;
  if (act.kind === 'm') return { text: m?.kind === 'number' ? `M${String(m.number)}` : 'M' };
  if (textOnly) return { key: 'cnc.type.text' };
  if (block.words.length > 0) return act.kind === 'unknown' ? { text: '?' } : { key: 'cnc.type.values' };
  return block.tokens.some(({ kind }) => kind === 'comment') ? { key: 'cnc.type.comment' } : { text: '' };
}

/** The word that a column shows. */
function wordIn(block: Block, column: Column): Word | undefined {
  if (column !== 'acceleration' && column !== 'deceleration') return wordOf(block, letterOf(column));
  return block.words.find(
    ({ address, value }) =>
      address === 'E' && (value.kind === 'number' && value.number < 0) === (column === 'deceleration'),
  );
}

/** Whether elements of the row's type have the value (CNC-42). */
export function isAvailable({ block, act, textOnly }: Row, column: Column): boolean {
  if (textOnly) return wordIn(block, column) !== undefined || (column === 'comment' && commentOf(block) !== '');
  if (column === 'comment') return true;
  if (block.words.length === 0) return false;
  if (column === 'n') return true;
  const letters = lettersOf(act);
  return letters === null
    ? 'FEDS'.includes(letterOf(column)) || wordIn(block, column) !== undefined
    : letters.has(letterOf(column));
}

export interface Cell {
  readonly text: string;
  /** It holds by an earlier block. */
  readonly modal: boolean;
}

export function cellOf(row: Row, column: Column): Cell {
  if (column === 'comment') return { text: commentOf(row.block), modal: false };
  const word = wordIn(row.block, column);
  if (word !== undefined) return { text: row.block.text.slice(word.valueAt, word.end), modal: false };
  const value = isAvailable(row, column) ? modalOf(row, column) : undefined;
  return { text: value === undefined || !Number.isFinite(value) ? '' : numberText(value), modal: true };
}

/** What holds where the block says nothing: coordinates in absolute mode, velocity and accelerations. */
function modalOf({ act, state }: Row, column: Column): number | undefined {
  const axis = column.length === 1 ? AXES.indexOf(column.toUpperCase()) : -1;
  if (axis >= 0) return state.relative || act.kind === 'm' ? undefined : programmed(state)[axis];
  if (column === 'deceleration') return state.rates['E-'];
  return ['f', 's', 'ff', 'ef', 'acceleration'].includes(column) ? state.rates[letterOf(column)] : undefined;
}

/** Why a text cannot stand in a cell, or null; empty takes the word away. */
export function cellFault(column: Column, typed: string): TextKey | null {
  const text = typed.trim();
  if (text === '') return null;
  if (column === 'comment') return text.includes(')') ? 'cnc.noClosing' : null;
  const number = typedNumber(text);
  if (Number.isNaN(number)) return 'cnc.number';
  if (column === 'n' && !isBlockNumber(number)) return 'cnc.wholeNumber';
  return column === 'h' && !Number.isInteger(number) ? 'cnc.number' : null;
}

/** The line with another text in a cell. */
export function withCell(block: Block, column: Column, typed: string): string {
  const text = typed.trim().replace(',', '.');
  if (column === 'comment') return withComment(block, typed.trim());
  const value = text === '' ? null : signed(column, text);
  return withValue(block, wordIn(block, column), letterOf(column), value);
}

function signed(column: Column, text: string): string {
  const size = text.replace(/^[+-]/, '');
  if (column === 'acceleration') return size;
  return column === 'deceleration' ? `-${size}` : text;
}

function withComment(block: Block, comment: string): string {
  const first = block.tokens.find(({ kind }) => kind === 'comment');
  if (first === undefined)
    return comment === '' ? block.text : `${block.text}${block.text === '' ? '' : ' '}(${comment})`;
  if (comment === '') return cutOut(block.text, first.at, first.end);
  return replaced(block.text, first.at, first.end, `(${comment})`);
}

/** The line as an element of another type: it keeps the words that those have. */
export function withType(block: Block, type: string): string {
  const code = type.startsWith('G') ? Number(type.slice(1)) : null;
  const command = block.words.find(({ address }) => address === 'G' || address === 'M');
  const written = code === null ? `M${type.slice(1) || '1'}` : type;
  const given =
    command === undefined
      ? withWord(block, written[0]!, written.slice(1))
      : replaced(block.text, command.at, command.end, written);
  const letters = lettersOf(code === null ? { kind: 'm' } : { kind: 'g', code });
  return readBlock(given)
    .words.filter(({ address }) => !'GMN'.includes(address) && letters?.has(address) === false)
    .reverse()
    .reduce((text, { at, end }) => cutOut(text, at, end), given);
}

/** The same value in all rows where the column is available and the table can change it (CNC-45). */
export function appliedToAll(rows: Iterable<Row>, column: Column, text: string): LinesEdit[] {
  const edits: LinesEdit[] = [];
  let line = 0;
  for (const row of rows) {
    if (!row.textOnly && isAvailable(row, column)) {
      const next = withCell(row.block, column, text);
      if (next !== row.block.text) edits.push(lineEdit(line, next));
    }
    line++;
  }
  return edits;
}

/** A block between two others, with the values of the one before it (CNC-43) and a number that fits. */
export function newElement(before: Block | undefined, behind: Block | undefined): string {
  const plain = before !== undefined && before.words.length > 0 ? before : readBlock('G1 X0 Y0');
  const word = wordOf(plain, 'N');
  const text = word === undefined ? plain.text : cutOut(plain.text, word.at, word.end);
  const least = before?.number ?? null;
  const next = behind?.number ?? null;
  const number = least === null ? null : next === null ? least + 10 : least + Math.floor((next - least) / 2);
  const fits = number !== null && number > least! && (next === null || number < next);
  return fits ? withWord(readBlock(text), 'N', String(number)) : text;
}

/** Lines that are rows: the end of a text behind its last break is none. */
export function rowCount(count: number, last: string): number {
  return last === '' ? count - 1 : count;
}

/** A first element behind all rows. */
export function appended(count: number, last: string, text: string): LinesEdit {
  const rows = rowCount(count, last);
  return rows < count ? { from: rows, removed: 1, lines: [text, ''] } : { from: count, removed: 0, lines: [text] };
}

/** Lines moved up or down by one, in front of or behind their neighbour; null where there is none. */
export function moved(
  lines: readonly string[],
  first: number,
  last: number,
  by: -1 | 1,
  rows: number,
): LinesEdit | null {
  if (by < 0 ? first === 0 : last + 1 >= rows) return null;
  const block = lines.slice(first, last + 1);
  return by < 0
    ? { from: first - 1, removed: block.length + 1, lines: [...block, lines[first - 1]!] }
    : { from: first, removed: block.length + 1, lines: [lines[last + 1]!, ...block] };
}
