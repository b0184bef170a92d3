/** Edits of one cell of one row. Each takes the text and gives the new one; only the cell's range changes. */

import { commentBehind, commentLines, joinComments } from './comments';
import { lineBreakOf, type DeclarationModel, type Range, type Row } from './model';
import { parseDeclaration } from './parse';
import { indentationAt, removeRange, replaceRange, startsLine, type TextChange } from './text';

class RowNotEditable extends Error {
  constructor(public readonly row: number) {
    super(`row ${String(row + 1)} can only be edited in the text view`);
  }
}

/** The row with this number; throws where the table offers no cell editing (DECL-21). */
export function editableRow(model: DeclarationModel, index: number): Row {
  const row = model.rows[index];
  if (row === undefined || row.special !== null) throw new RowNotEditable(index);
  return row;
}

/**
 * Gives a variable of `A, B, C : T;` a statement of its own, in place: attributes, type, initial value and
 * comments are repeated, so that each variable keeps what was said of all.
 */
function separateShared(text: string, index: number): string {
  const model = parseDeclaration(text);
  const row = editableRow(model, index);
  if (row.shared === 1) return text;
  const group = model.rows.filter((r) => r.statement === row.statement);
  const position = group.indexOf(row);
  const afterNames = nameListEnd(text, group);
  const pieces = [group.slice(0, position), [row], group.slice(position + 1)]
    .filter((part) => part.length > 0)
    .map((part) => namesText(text, group, part, afterNames));
  const start = row.core.start;
  const end = Math.max(row.trail.end, row.separator?.end ?? row.core.end);
  const before = text.slice(start, row.element.start);
  const after = text.slice(afterNames, end);
  const joint = lineBreakOf(text) + indentationAt(text, start);
  return replaceRange(text, { start, end }, pieces.map((names) => before + names + after).join(joint));
}

/** Where the name list ends: behind the last name and the comments next to it. */
function nameListEnd(text: string, group: readonly Row[]): number {
  const last = group[group.length - 1] as Row;
  const next = last.address ?? last.type;
  const until = text.slice(last.name.end, next?.start ?? last.element.end);
  const colon = last.address === null ? until.lastIndexOf(':') : until.toUpperCase().lastIndexOf('AT');
  const blank = /\s*$/.exec(until.slice(0, colon))?.[0].length ?? 0;
  return last.name.end + colon - blank;
}

function namesText(text: string, group: readonly Row[], part: readonly Row[], afterNames: number): string {
  const first = part[0] as Row;
  const last = part[part.length - 1] as Row;
  const next = group[group.indexOf(last) + 1];
  if (next === undefined) return text.slice(first.name.start, afterNames);
  const between = text.slice(last.name.end, next.name.start);
  const comma = lastCommaOutsideComments(between);
  const rest = between.slice(comma + 1).trim();
  return text.slice(first.name.start, last.name.end) + between.slice(0, comma).trimEnd() + (rest && ` ${rest}`);
}

function lastCommaOutsideComments(between: string): number {
  const blanked = between.replace(/\(\*[\s\S]*?\*\)|\/\/[^\n]*/g, (c) => ' '.repeat(c.length));
  return blanked.lastIndexOf(',');
}

export function setName(text: string, index: number, name: string): string {
  return replaceRange(text, editableRow(parseDeclaration(text), index).name, name);
}

export function setType(text: string, index: number, type: string): string {
  const row = editableRow(parseDeclaration(text), index);
  if (row.type === null || row.type.text === type) return text;
  if (row.shared > 1) return setType(separateShared(text, index), index, type);
  return replaceRange(text, row.type, type);
}

export function setAddress(text: string, index: number, address: string): string {
  const row = editableRow(parseDeclaration(text), index);
  if ((row.address?.text ?? '') === address) return text;
  if (row.shared > 1) return setAddress(separateShared(text, index), index, address);
  if (row.address === null) {
    return replaceRange(text, { start: row.name.end, end: row.name.end }, ` AT ${address}`);
  }
  if (address !== '') return replaceRange(text, row.address, address);
  const at = row.name.end + text.slice(row.name.end, row.address.start).toUpperCase().lastIndexOf('AT');
  const blank = /\s*$/.exec(text.slice(row.name.end, at))?.[0].length ?? 0;
  return replaceRange(text, { start: at - blank, end: row.address.end }, '');
}

export function setInitial(text: string, index: number, initial: string): string {
  const row = editableRow(parseDeclaration(text), index);
  if ((row.initial?.text ?? '') === initial) return text;
  if (row.shared > 1) return setInitial(separateShared(text, index), index, initial);
  if (row.initial !== null && row.assign !== null) {
    if (initial !== '') return replaceRange(text, row.initial, initial);
    const blank = /\s*$/.exec(text.slice(row.core.start, row.assign.start))?.[0].length ?? 0;
    return replaceRange(text, { start: row.assign.start - blank, end: row.initial.end }, '');
  }
  const end = row.element.end;
  return replaceRange(text, { start: end, end }, ` := ${initial}`);
}

export function setComment(text: string, index: number, comment: string): string {
  const row = editableRow(parseDeclaration(text), index);
  if (comment === joinComments(row.comments.map((cell) => cell.text))) return text;
  if (comment === '') return row.comments.reduceRight<string>((t, c) => removeComment(t, c), text);
  const lines = comment.split('\n');
  const single = row.comments.length === 1 ? row.comments[0] : undefined;
  if (single !== undefined && (lines.length === 1 || (single.text.startsWith('(*') && !comment.includes('*)')))) {
    return replaceRange(text, single, commentBehind(comment, single.text));
  }
  if (row.comments.length === 0 && lines.length === 1) return appendComment(text, row, comment);
  const cleared = row.comments.reduceRight<string>((t, c) => removeComment(t, c), text);
  return commentAbove(cleared, index, comment);
}

function removeComment(text: string, range: Range): string {
  if (startsLine(text, range.start)) return removeRange(text, range);
  const blank = /[ \t]*$/.exec(text.slice(0, range.start))?.[0].length ?? 0;
  return replaceRange(text, { start: range.start - blank, end: range.end }, '');
}

function appendComment(text: string, row: Row, comment: string): string {
  const at = Math.max(row.trail.end, row.separator?.end ?? row.element.end);
  const rest = /^[ \t]*/.exec(text.slice(at))?.[0].length ?? 0;
  const behind = text[at + rest];
  const free = behind === undefined || behind === '\n' || behind === '\r';
  const block = !comment.includes('*)') && !comment.includes('(*');
  if (free) return replaceRange(text, { start: at, end: at }, ` // ${comment}`);
  if (block) return replaceRange(text, { start: at, end: at }, ` (* ${comment} *)`);
  return replaceRange(text, { start: at, end: at + rest }, ` // ${comment}${lineBreakOf(text)}`);
}

function commentAbove(text: string, index: number, comment: string): string {
  const row = editableRow(parseDeclaration(text), index);
  const at = row.element.start;
  const newline = lineBreakOf(text);
  const indentation = indentationAt(text, at);
  const lead = startsLine(text, at) ? '' : newline + indentation;
  const lines = commentLines(comment).map((line) => line + newline + indentation);
  return replaceRange(text, { start: at, end: at }, lead + lines.join(''));
}

/** Contents of `{...}` as the Attributes dialog shows them: one a line, without the braces (DECL-32). */
export function attributeLines(row: { readonly attributes: readonly { readonly text: string }[] }): string[] {
  return row.attributes.map((cell) => cell.text.replace(/^\{\s*/, '').replace(/\s*\}$/, ''));
}

/** Writes the attribute lines of a row: unchanged ones stay untouched, new ones go in front of the variable. */
export function setAttributes(text: string, index: number, lines: readonly string[]): string {
  const row = editableRow(parseDeclaration(text), index);
  const old = attributeLines(row);
  if (row.shared > 1 && lines.join('\n') !== old.join('\n')) {
    return setAttributes(separateShared(text, index), index, lines);
  }
  return writeAttributes(text, row.attributes, old, lines, row.element.start);
}

/** Replaces pragma ranges one for one; surplus ones are removed, missing ones inserted before `element`. */
export function writeAttributes(
  text: string,
  ranges: readonly Range[],
  old: readonly string[],
  lines: readonly string[],
  element: number,
): string {
  let result = text;
  const changes: TextChange[] = ranges.map((range, i) => ({
    ...range,
    text: lines[i] === undefined ? '' : `{${lines[i]}}`,
  }));
  if (lines.length > old.length) {
    const newline = lineBreakOf(text);
    const indentation = indentationAt(text, element);
    const lead = startsLine(text, element) ? '' : newline + indentation;
    const added = lines.slice(old.length).map((line) => `{${line}}${newline}${indentation}`);
    changes.push({ start: element, end: element, text: lead + added.join('') });
  }
  for (const change of changes.sort((a, b) => b.start - a.start)) {
    if (change.text === '') result = removeRange(result, change);
    else if (change.text !== text.slice(change.start, change.end)) {
      const same = change.end > change.start && sameAttribute(text, change);
      if (!same) result = replaceRange(result, change, change.text);
    }
  }
  return result;
}

/** Whether only blanks next to the braces differ, which the dialog does not show. */
function sameAttribute(text: string, change: TextChange): boolean {
  const strip = (pragma: string) => pragma.replace(/^\{\s*/, '').replace(/\s*\}$/, '');
  return strip(text.slice(change.start, change.end)) === strip(change.text);
}
