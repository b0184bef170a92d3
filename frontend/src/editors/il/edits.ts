/**
 * What the acts of the IL table do to the text. Each returns the whole new text; outside of the cells and rows that
 * are meant, not a character changes.
 */
import { commentBehind } from '@/iec/declaration/comments';
import { replaceRange } from '@/iec/declaration/text';
import { isTrivia, textOf, tokenize, type Token } from '@/iec/lexer';
import { blanked, exclude, include, markOf } from './excluded';
import { cellText, parseRows, type IlColumn, type IlRow } from './rows';

/** Columns of operators and operands where no row shows others; formatting uses the same. */
const OPERATOR_COLUMN = 8;
const OPERAND_COLUMN = 16;

export interface Edited {
  readonly text: string;
  /** The row the act was about, or the first of them. */
  readonly row: number;
}

/** The text after a cell was given another content; an empty one takes the cell away. */
export function setCell(text: string, index: number, column: IlColumn, content: string): string {
  const rows = parseRows(text);
  const row = rows[index];
  if (row === undefined || row.excluded || content === cellText(row, column)) return text;
  if (column === 'comment') return withComment(text, rows, row, content);
  const value = content.replace(/\s*\n\s*/g, ' ').trim();
  if (value === cellText(row, column)) return text;
  if (row.kind === 'label') return withLabel(text, row, value);
  return row[column] === null ? withNewCell(text, rows, row, column, value) : withCell(text, row, column, value);
}

/** Why a content cannot stand in its cell, or null: what does not end there would swallow the cells behind it. */
export function cellProblem(row: IlRow, column: IlColumn, content: string): 'comment' | 'open' | null {
  if (column === 'comment') return null;
  const tokens = tokenize(content);
  if (isOpen(content, tokens.at(-1))) return 'open';
  return row.kind !== 'raw' && tokens.some(isTrivia) ? 'comment' : null;
}

function isOpen(content: string, last: Token | undefined): boolean {
  const text = last === undefined ? '' : textOf(content, last);
  if (last?.kind === 'comment') return text.startsWith('(*') && tokenize(`${content} *)`).at(-1)?.kind === 'comment';
  if (last?.kind === 'string') return text.length < 2 || !text.endsWith("'");
  return last?.kind === 'wstring' && (text.length < 2 || !text.endsWith('"'));
}

function withCell(text: string, row: IlRow, column: 'operator' | 'operand', value: string): string {
  const cell = row[column]!;
  const behind = column === 'operator' ? (row.operand ?? row.comment) : row.comment;
  if (behind === null) {
    const before = column === 'operand' ? row.operator : null;
    const start = value === '' ? (before?.end ?? row.start) : cell.start;
    return replaceRange(text, { start, end: cell.end }, value);
  }
  // What stands behind keeps its column as long as there is room.
  const gap = text.slice(cell.end, behind.start);
  const width = behind.start - cell.start;
  const padded =
    gap.trim() === '' && !gap.includes('\t') ? (value.length < width ? value.padEnd(width) : `${value} `) : value + gap;
  return replaceRange(text, { start: cell.start, end: behind.start }, padded);
}

function withNewCell(
  text: string,
  rows: readonly IlRow[],
  row: IlRow,
  column: 'operator' | 'operand',
  value: string,
): string {
  const behind = column === 'operator' ? (row.operand ?? row.comment) : row.comment;
  const before = column === 'operand' ? row.operator : null;
  const place = columnsNear(rows, row);
  const lead =
    before === null
      ? column === 'operator'
        ? indentationNear(text, rows, row)
        : ' '.repeat(place.operand)
      : ' '.repeat(Math.max(1, place.operand - (before.end - row.lineStart)));
  const start = before?.end ?? row.start;
  const head = lead + value;
  if (behind === null) return replaceRange(text, { start, end: row.end }, head);
  const gap = Math.max(1, behind.start - start - head.length);
  return replaceRange(text, { start, end: behind.start }, head + ' '.repeat(gap));
}

function withLabel(text: string, row: IlRow, value: string): string {
  const label = row.operator!;
  if (value === '') return replaceRange(text, label, ' '.repeat(label.end - label.start));
  const named = value.endsWith(':') ? value : `${value}:`;
  const spaces = /^ */.exec(text.slice(label.end))?.[0].length ?? 0;
  const spare = Math.max(0, Math.min(spaces - 1, named.length - label.text.length));
  return replaceRange(text, { start: label.start, end: label.end + spare }, named);
}

function withComment(text: string, rows: readonly IlRow[], row: IlRow, content: string): string {
  const value = content.replace(/[ \t]+$/gm, '').replace(/^\n+|\n+$/g, '');
  const before = row.operand ?? row.operator;
  if (row.comment !== null) {
    const start = value === '' ? (before?.end ?? row.start) : row.comment.start;
    return replaceRange(
      text,
      { start, end: row.comment.end },
      value === '' ? '' : commentCode(value, row.comment.text),
    );
  }
  const sharesLine = row.end < text.length && text[row.end] !== '\n';
  if (value === '' || sharesLine) return text;
  const code = commentCode(value, null);
  if (before === null)
    return replaceRange(text, { start: row.start, end: row.end }, indentationNear(text, rows, row) + code);
  const gap = Math.max(1, commentColumnNear(rows, row) - (before.end - row.lineStart));
  return replaceRange(text, { start: before.end, end: row.end }, ' '.repeat(gap) + code);
}

/** A comment with its delimiters, those of `like` where they can hold the text. */
function commentCode(value: string, like: string | null): string {
  if (!value.includes('\n')) return commentBehind(value, like);
  return `(* ${value.replaceAll('(*', '( *').replaceAll('*)', '* )')} *)`;
}

/** Rows sorted by their distance from `row`, those above it first. */
function* neighbours(rows: readonly IlRow[], row: IlRow): Iterable<IlRow> {
  const at = rows.indexOf(row);
  for (let above = at - 1; above >= 0; above -= 1) yield rows[above]!;
  for (let below = at + 1; below < rows.length; below += 1) yield rows[below]!;
}

function columnsNear(rows: readonly IlRow[], row: IlRow): { operator: number; operand: number } {
  let operator: number | null = null;
  for (const near of neighbours(rows, row)) {
    if (near.kind !== 'instruction' || near.operator === null) continue;
    operator ??= near.operator.start - near.lineStart;
    if (near.operand !== null) return { operator, operand: near.operand.start - near.lineStart };
  }
  return { operator: operator ?? OPERATOR_COLUMN, operand: OPERAND_COLUMN };
}

/** White space in front of the nearest instruction, as wide as its label where one stands there. */
function indentationNear(text: string, rows: readonly IlRow[], row: IlRow): string {
  for (const near of neighbours(rows, row)) {
    if (near.kind !== 'instruction' || near.operator === null) continue;
    return text.slice(near.lineStart, near.operator.start).replace(/\S/g, ' ');
  }
  return ' '.repeat(OPERATOR_COLUMN);
}

function commentColumnNear(rows: readonly IlRow[], row: IlRow): number {
  for (const near of neighbours(rows, row))
    if (near.comment !== null && near.kind !== 'comment') return near.comment.start - near.lineStart;
  return 0;
}

/** The text with a line break in front of a row that shares its line with a label, and where the row then begins. */
function onItsOwnLine(text: string, row: IlRow): { text: string; at: number } {
  if (row.start === row.lineStart) return { text, at: row.start };
  const lead = blanked(text.slice(row.lineStart, (row.operator ?? row).start));
  const rest = text.slice(row.start).replace(/^[ \t]+/, '');
  return { text: `${text.slice(0, row.start)}\n${lead}${rest}`, at: row.start + 1 };
}

/** `lines` in front of a row, or behind the last one; amid a network that is commented out they are so, too. */
function insertLines(text: string, before: number, lines: string): string {
  const rows = parseRows(text);
  const row = rows[before];
  if (row !== undefined) {
    const split = onItsOwnLine(text, row);
    return `${split.text.slice(0, split.at)}${asAround(rows, before, lines)}\n${split.text.slice(split.at)}`;
  }
  return `${text}\n${lines}`;
}

/** Lines as they have to be in front of a row: commented out between two rows of a network that is. */
function asAround(rows: readonly IlRow[], before: number, lines: string): string {
  const [above, below] = [rows[before - 1], rows[before]];
  const amid = above?.excluded === true && below?.excluded === true && above.network === below.network;
  const marked = (line: string) => (markOf(line) === '' ? exclude(line) : line);
  return amid ? lines.split('\n').map(marked).join('\n') : lines;
}

/** A blank row below a row (IL-05), or at the end. */
export function insertRow(text: string, after: number | null): Edited {
  const count = parseRows(text).length;
  const row = after === null ? count : Math.min(after + 1, count);
  return { text: insertLines(text, row, ''), row };
}

/** A label of its own above a row; it begins a network there (IL-09). */
export function insertLabel(text: string, before: number): Edited {
  const taken = new Set(
    parseRows(text).flatMap((row) => (row.kind === 'label' ? [cellText(row, 'operator').toUpperCase()] : [])),
  );
  let number = 1;
  while (taken.has(`LABEL${String(number)}:`)) number += 1;
  return { text: insertLines(text, before, `Label${String(number)}:`), row: before };
}

interface TextLine {
  readonly start: number;
  end: number;
  readonly rows: number[];
}

/** Rows grouped by the line they stand in. */
function linesOf(text: string, rows: readonly IlRow[]): readonly TextLine[] {
  const lines: TextLine[] = [];
  rows.forEach((row, index) => {
    const last = lines.at(-1);
    if (last?.start === row.lineStart) last.rows.push(index);
    else {
      if (last !== undefined) last.end = row.lineStart - 1;
      lines.push({ start: row.lineStart, end: text.length, rows: [index] });
    }
  });
  return lines;
}

/** What is left of a line without some of its rows; null when nothing is. */
function withoutRows(text: string, rows: readonly IlRow[], line: TextLine, gone: ReadonlySet<number>): string | null {
  if (line.rows.every((row) => gone.has(row))) return null;
  const parts = line.rows.map((index, at) => {
    const row = rows[index]!;
    const part = text.slice(row.start, row.end);
    if (!gone.has(index)) return part;
    return at === line.rows.length - 1 ? '' : blanked(part);
  });
  return parts.join('');
}

/** The text without the rows (IL-06); a label stays when only its instruction goes, and the other way round. */
export function deleteRows(text: string, chosen: readonly number[]): string {
  const rows = parseRows(text);
  const gone = new Set(chosen);
  return linesOf(text, rows)
    .flatMap((line) => withoutRows(text, rows, line, gone) ?? [])
    .join('\n');
}

/** What the clipboard gets: the lines of the rows, of a label and its instruction only what is chosen. */
export function copyRows(text: string, chosen: readonly number[]): string {
  const rows = parseRows(text);
  const wanted = new Set(chosen);
  return linesOf(text, rows)
    .flatMap((line) => {
      const own = line.rows.filter((row) => wanted.has(row));
      if (own.length === 0) return [];
      if (own.length === line.rows.length) return [text.slice(line.start, line.end)];
      const parts = own.map((index) => include(text.slice(rows[index]!.start, rows[index]!.end)).trim());
      const first = rows[own[0]!]!;
      return [blanked(text.slice(line.start, (first.operator ?? first).start)) + parts.join(' ')];
    })
    .join('\n');
}

/** Rows moved, or copied, in front of a row or (at the number of rows) to the end (NET-10, FBD-07). */
export function moveRows(
  text: string,
  chosen: readonly number[],
  before: number,
  copy: boolean,
): Edited & { readonly count: number } {
  const rows = parseRows(text);
  const sorted = [...chosen].sort((a, b) => a - b);
  const [first, last] = [sorted[0] ?? 0, sorted.at(-1) ?? -1];
  const together = last - first + 1 === sorted.length;
  if (sorted.length === 0 || (!copy && together && before >= first && before <= last + 1))
    return { text, row: first, count: sorted.length };
  const target = rows[before];
  if (target !== undefined && target.start !== target.lineStart)
    return moveRows(onItsOwnLine(text, target).text, chosen, before, copy);
  const gone = new Set(copy ? [] : sorted);
  const moved = asAround(rows, before, copyRows(text, sorted));
  // A blank row at the end stays the last one.
  const end = rows.length - (rows.at(-1)?.kind === 'blank' && !gone.has(rows.length - 1) ? 1 : 0);
  const at = Math.min(before, end);
  const lines: string[] = [];
  let place = -1;
  const put = () => {
    place = lines.length === 0 ? 0 : lines.join('\n').length + 1;
    lines.push(moved);
  };
  for (const line of linesOf(text, rows)) {
    if (line.rows[0] === at) put();
    const left = withoutRows(text, rows, line, gone);
    if (left !== null) lines.push(left);
  }
  if (place < 0) put();
  const made = lines.join('\n');
  // Behind a comment that does not end, nothing has a row of its own.
  const now = parseRows(made);
  const row = now.findIndex(({ start }) => start >= place);
  return { text: made, row: row < 0 ? now.length - 1 : row, count: sorted.length };
}

/** The network of a row commented out, or again as it was (NET-07). */
export function toggleNetwork(text: string, row: number): string {
  const rows = parseRows(text);
  const own = rows.filter(({ network }) => network === rows[row]?.network);
  const [first, last] = [own[0], own.at(-1)];
  if (first === undefined || last === undefined || own.every(({ kind }) => kind === 'blank')) return text;
  const change = isActive(own) ? exclude : include;
  const lines = text.slice(first.lineStart, last.end).split('\n');
  return replaceRange(text, { start: first.lineStart, end: last.end }, lines.map(change).join('\n'));
}

/** Whether a network does something; blank rows do not count. */
function isActive(network: readonly IlRow[]): boolean {
  return network.some(({ kind, excluded }) => !excluded && kind !== 'blank');
}

const NEGATABLE = /^((?:LD|ST|AND|OR|XOR|JMPC|CALC|RETC)|JMP(?=N)|&)(N?)(\s*\(?)$/i;

/** An operator with its operand or condition negated, or no longer so (IL-21, IL-22); null where there is no such. */
export function negated(operator: string): string | null {
  const [, word = '', negation = '', rest = ''] = NEGATABLE.exec(operator) ?? [];
  if (word === '') return null;
  // JMPN is another spelling of JMPCN.
  if (/^JMP$/i.test(word)) return `${word}${negation === 'n' ? 'c' : 'C'}${rest}`;
  if (negation !== '') return word + rest;
  return word === '&' ? `ANDN${rest}` : `${word}${word === word.toLowerCase() ? 'n' : 'N'}${rest}`;
}

/** The text with the operators of rows negated, or no longer so; those that cannot be stay as they are. */
export function negateRows(text: string, chosen: readonly number[]): string {
  const rows = parseRows(text);
  // From the end, so that the places of the rows before stay right.
  return [...chosen]
    .sort((a, b) => b - a)
    .reduce((done, index) => {
      const row = rows[index];
      const operator = row === undefined ? null : negatedOf(row);
      return row === undefined || operator === null ? done : withCell(done, row, 'operator', operator);
    }, text);
}

/** The operator of a row negated, or no longer so; null where that is not possible. */
export function negatedOf(row: IlRow): string | null {
  return row.kind !== 'instruction' || row.excluded ? null : negated(cellText(row, 'operator'));
}

/** Lines of the clipboard in front of a row, or at the end (IL-07), where a blank last row gives way. */
export function pasteRows(text: string, before: number | null, clipboard: string): Edited & { readonly count: number } {
  const lines = clipboard.replace(/\r\n?/g, '\n').replace(/\n$/, '');
  const rows = parseRows(text);
  const count = parseRows(lines).length;
  if (text === '') return { text: lines, row: 0, count };
  const end = rows.length - (rows.at(-1)?.kind === 'blank' ? 1 : 0);
  const row = before ?? end;
  return { text: insertLines(text, row, lines), row, count };
}
