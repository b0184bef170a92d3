/**
 * What the acts of the IL table do to the text. Each returns the whole text anew; outside of the cells and rows that
 * are meant, not a character changes.
 */
import { commentBehind } from '../declaration/comments';
import { replaceRange } from '../declaration/text';
import { isTrivia, textOf, tokenize, type Token } from '../st/lexer';
import { cellText, parseRows, segmentsOf, type IlColumn, type IlRow } from './rows';

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
  if (row === undefined || content === cellText(row, column)) return text;
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
  const lead = text.slice(row.lineStart, (row.operator ?? row).start).replace(/\S/g, ' ');
  const rest = text.slice(row.start).replace(/^[ \t]+/, '');
  return { text: `${text.slice(0, row.start)}\n${lead}${rest}`, at: row.start + 1 };
}

/** `lines` in front of a row, or behind the last one. */
function insertLines(text: string, before: number, lines: string): string {
  const row = parseRows(text)[before];
  if (row !== undefined) {
    const split = onItsOwnLine(text, row);
    return `${split.text.slice(0, split.at)}${lines}\n${split.text.slice(split.at)}`;
  }
  return `${text}\n${lines}`;
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

/** Rows grouped by the line they stand in. */
function linesOf(text: string): { start: number; end: number; rows: number[] }[] {
  const lines = segmentsOf(text).map(({ start, end }) => ({ start, end, rows: [] as number[] }));
  const byStart = new Map(lines.map((line) => [line.start, line]));
  parseRows(text).forEach((row, index) => byStart.get(row.lineStart)?.rows.push(index));
  return lines;
}

/** The text without the rows (IL-06); a label stays when only its instruction goes, and the other way round. */
export function deleteRows(text: string, chosen: readonly number[]): string {
  const rows = parseRows(text);
  const gone = new Set(chosen);
  const kept = linesOf(text).flatMap((line) => {
    if (line.rows.length > 0 && line.rows.every((row) => gone.has(row))) return [];
    const parts = line.rows.map((index, at) => {
      const row = rows[index]!;
      const part = text.slice(row.start, row.end);
      if (!gone.has(index)) return part;
      return at === line.rows.length - 1 ? '' : part.replace(/\S/g, ' ');
    });
    return [line.rows.length === 0 ? text.slice(line.start, line.end) : parts.join('')];
  });
  return kept.join('\n');
}

/** What the clipboard gets: the lines of the rows, of a label and its instruction only what is chosen. */
export function copyRows(text: string, chosen: readonly number[]): string {
  const rows = parseRows(text);
  const wanted = new Set(chosen);
  return linesOf(text)
    .flatMap((line) => {
      const own = line.rows.filter((row) => wanted.has(row));
      if (own.length === 0) return [];
      if (own.length === line.rows.length) return [text.slice(line.start, line.end)];
      const parts = own.map((index) => text.slice(rows[index]!.start, rows[index]!.end).trim());
      const first = rows[own[0]!]!;
      const lead = text.slice(line.start, (first.operator ?? first).start).replace(/\S/g, ' ');
      return [lead + parts.join(' ')];
    })
    .join('\n');
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
