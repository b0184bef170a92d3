/** Edits of whole rows: insert, delete, move, change of scope. Blocks are split and joined around them. */

import { editableRow } from './cells';
import { lineBreakOf, type Block, type DeclarationModel, type Range, type Row } from './model';
import { parseDeclaration } from './parse';
import {
  endsLine,
  indentationAt,
  lineStart,
  nextLine,
  removeRange,
  replaceRange,
  startsLine,
  wholeLines,
} from './text';

export interface NewVariable {
  readonly scope: string;
  readonly flags: readonly string[];
  readonly name: string;
  readonly address?: string;
  readonly type: string;
  readonly initial?: string;
  readonly comment?: string;
  readonly attributes?: readonly string[];
}

/** All of a row that moves with it: leading trivia, declaration, separator and what stands behind in the line. */
function extentOf(row: Row): Range {
  return { start: row.core.start, end: Math.max(row.trail.end, row.separator?.end ?? row.core.end) };
}

/** The declaration statement of `variable` in one line, without indentation (DECL-70). */
function declarationLine(variable: NewVariable): string {
  const address = variable.address ? ` AT ${variable.address}` : '';
  const initial = variable.initial ? ` := ${variable.initial}` : '';
  return `${variable.name}${address} : ${variable.type}${initial};`;
}

function sameFlags(a: readonly string[], b: readonly string[]): boolean {
  return a.length === b.length && a.every((flag) => b.includes(flag));
}

function headText(scope: string, flags: readonly string[]): string {
  return [scope, ...flags].join(' ');
}

function rowsOf(model: DeclarationModel, block: number): number[] {
  return model.rows.flatMap((row, index) => (row.block === block ? [index] : []));
}

/** Deletes rows (DECL-35). A name in a shared list goes alone; the block stays even when it gets empty. */
export function deleteRows(text: string, indices: readonly number[]): string {
  return [...new Set(indices)].sort((a, b) => b - a).reduce(deleteRow, text);
}

function deleteRow(text: string, index: number): string {
  const model = parseDeclaration(text);
  const row = model.rows[index];
  if (row === undefined) return text;
  if (row.shared > 1) return deleteSharedName(text, model, index);
  const enumeration = model.blocks[row.block]?.frame === 'enumeration';
  const previous = model.rows[index - 1];
  const last = enumeration && row.separator === null && previous !== undefined && previous.block === row.block;
  const removed = removeRange(text, extentOf(row));
  if (!last || previous.separator === null) return removed;
  return replaceRange(removed, previous.separator, '');
}

function deleteSharedName(text: string, model: DeclarationModel, index: number): string {
  const row = model.rows[index] as Row;
  const next = model.rows[index + 1];
  if (next !== undefined && next.statement === row.statement) {
    return replaceRange(text, { start: row.name.start, end: next.name.start }, '');
  }
  const previous = model.rows[index - 1] as Row;
  return replaceRange(text, { start: previous.name.end, end: row.name.end }, '');
}

/**
 * Inserts a variable before row `before`, or behind the last row when null. It joins the block at that place
 * when scope and flags are the same; otherwise it gets a block of its own there (DECL-36).
 */
export function insertRow(text: string, before: number | null, variable: NewVariable): string {
  const model = parseDeclaration(text);
  const frame = model.blocks[0]?.frame ?? 'variables';
  if (frame === 'enumeration') return insertValue(text, model, before, variable);
  const target = before === null ? undefined : model.rows[before];
  if (target !== undefined && target.shared > 1) {
    const first = model.rows.findIndex((row) => row.statement === target.statement);
    return insertAt(text, model, first, variable);
  }
  return insertAt(text, model, target === undefined ? null : before, variable);
}

function fits(block: Block | undefined, variable: NewVariable): boolean {
  if (block === undefined) return false;
  return block.frame === 'members' || (block.scope === variable.scope && sameFlags(block.flags, variable.flags));
}

function insertAt(text: string, model: DeclarationModel, before: number | null, variable: NewVariable): string {
  if (before !== null) {
    const target = model.rows[before] as Row;
    if (fits(model.blocks[target.block], variable)) return insertBefore(text, target, variable);
    const previous = model.rows[before - 1];
    if (previous !== undefined && previous.block !== target.block && fits(model.blocks[previous.block], variable)) {
      return insertAtEnd(text, model, previous.block, variable);
    }
    if (previous !== undefined && previous.block === target.block) {
      const split = splitBefore(text, before);
      const at = lineStart(split, (parseDeclaration(split).blocks[target.block + 1] as Block).head.start);
      return insertBlock(split, at, variable);
    }
    return insertBlock(text, lineStart(text, (model.blocks[target.block] as Block).head.start), variable);
  }
  const last = model.blocks.length - 1;
  if (fits(model.blocks[last], variable)) return insertAtEnd(text, model, last, variable);
  return appendBlock(text, model, variable);
}

function linesFor(variable: NewVariable, indentation: string, newline: string): string {
  const attributes = (variable.attributes ?? []).map((line) => `${indentation}{${line}}${newline}`);
  const comment = variable.comment ?? '';
  const above = comment.includes('\n')
    ? comment.split('\n').map((line) => `${indentation}// ${line}`.trimEnd() + newline)
    : [];
  const behind = comment !== '' && above.length === 0 ? ` // ${comment}` : '';
  return above.join('') + attributes.join('') + indentation + declarationLine(variable) + behind + newline;
}

function insertBefore(text: string, target: Row, variable: NewVariable): string {
  const newline = lineBreakOf(text);
  const start = target.core.start;
  const indentation = startsLine(text, start) ? indentationAt(text, start) : '    ';
  const lines = linesFor(variable, indentation, newline);
  if (startsLine(text, start)) {
    const at = lineStart(text, start);
    return replaceRange(text, { start: at, end: at }, lines);
  }
  return replaceRange(text, { start, end: start }, newline + lines + indentation);
}

function insertAtEnd(text: string, model: DeclarationModel, block: number, variable: NewVariable): string {
  const { head, tail } = model.blocks[block] as Block;
  const rows = rowsOf(model, block);
  const last = model.rows[rows[rows.length - 1] ?? -1];
  const newline = lineBreakOf(text);
  const indentation =
    last !== undefined && startsLine(text, last.core.start)
      ? indentationAt(text, last.core.start)
      : `${indentationAt(text, head.start)}    `;
  const lines = linesFor(variable, indentation, newline);
  if (last !== undefined && endsLine(text, extentOf(last).end)) {
    const at = nextLine(text, extentOf(last).end);
    if (at <= lineStart(text, tail.start)) return replaceRange(text, { start: at, end: at }, lines);
  }
  if (startsLine(text, tail.start)) {
    const at = lineStart(text, tail.start);
    return replaceRange(text, { start: at, end: at }, lines);
  }
  const blank = /[ \t]*$/.exec(text.slice(head.end, tail.start))?.[0].length ?? 0;
  return replaceRange(
    text,
    { start: tail.start - blank, end: tail.start },
    newline + lines + indentationAt(text, head.start),
  );
}

function blockLines(variable: NewVariable, newline: string): string {
  const head = headText(variable.scope, variable.flags);
  return head + newline + linesFor(variable, '    ', newline) + 'END_VAR' + newline;
}

function insertBlock(text: string, at: number, variable: NewVariable): string {
  return replaceRange(text, { start: at, end: at }, blockLines(variable, lineBreakOf(text)));
}

function appendBlock(text: string, model: DeclarationModel, variable: NewVariable): string {
  const newline = lineBreakOf(text);
  const last = model.blocks[model.blocks.length - 1];
  const end = last?.tail.end ?? model.header?.range.end ?? text.length;
  const at = nextLine(text, end);
  const lead = at > 0 && text[at - 1] !== '\n' ? newline : '';
  const lines = blockLines(variable, newline);
  const whole = at === text.length && !text.endsWith('\n') ? lines.slice(0, -newline.length) : lines;
  return replaceRange(text, { start: at, end: at }, lead + whole);
}

function insertValue(text: string, model: DeclarationModel, before: number | null, variable: NewVariable): string {
  const newline = lineBreakOf(text);
  const element = variable.name + (variable.initial ? ` := ${variable.initial}` : '');
  const comment = variable.comment ? ` // ${variable.comment.replace(/\n/g, ' ')}` : '';
  const target = before === null ? undefined : model.rows[before];
  if (target !== undefined) {
    const indentation = indentationAt(text, target.core.start);
    const own = startsLine(text, target.core.start);
    const joint = own || comment !== '' ? newline + indentation : ' ';
    const start = target.core.start;
    return replaceRange(text, { start, end: start }, `${element},${comment}${joint}`);
  }
  const last = model.rows[model.rows.length - 1];
  const block = model.blocks[0] as Block;
  if (last === undefined) {
    const end = block.head.end;
    return replaceRange(text, { start: end, end }, `${newline}    ${element}${comment}${newline}`);
  }
  const extent = extentOf(last);
  const own = startsLine(text, last.core.start);
  const joint = own ? newline + indentationAt(text, last.core.start) : ' ';
  const tail = comment !== '' && !endsLine(text, extent.end) ? newline : '';
  const inserted = replaceRange(text, { start: extent.end, end: extent.end }, joint + element + comment + tail);
  if (last.separator !== null) return inserted;
  return replaceRange(inserted, { start: last.element.end, end: last.element.end }, ',');
}

/** Ends the block before row `index` and opens the same one again, so that the row begins a block. */
function splitBefore(text: string, index: number): string {
  const model = parseDeclaration(text);
  const row = model.rows[index] as Row;
  const block = model.blocks[row.block] as Block;
  const newline = lineBreakOf(text);
  const indentation = indentationAt(text, block.head.start);
  const head = text.slice(block.head.start, block.head.end);
  const frame = `${indentation}END_VAR${newline}${indentation}${head}${newline}`;
  if (startsLine(text, row.core.start)) {
    const at = lineStart(text, row.core.start);
    return replaceRange(text, { start: at, end: at }, frame);
  }
  return replaceRange(text, { start: row.core.start, end: row.core.start }, newline + frame);
}

/** Puts a row into a block of its own; gives the text and the number of that block. */
function isolate(text: string, index: number): { text: string; block: number } {
  let result = text;
  let model = parseDeclaration(result);
  let row = model.rows[index] as Row;
  const next = model.rows[index + 1];
  if (next !== undefined && next.block === row.block) result = splitBefore(result, index + 1);
  const previous = model.rows[index - 1];
  if (previous !== undefined && previous.block === row.block) result = splitBefore(result, index);
  model = parseDeclaration(result);
  row = model.rows[index] as Row;
  return { text: result, block: row.block };
}

/** Joins block `number` with the one after it when nothing but white space lies between and they are alike. */
function joinWithNext(text: string, number: number): string {
  const { blocks } = parseDeclaration(text);
  const first = blocks[number];
  const second = blocks[number + 1];
  if (first === undefined || second === undefined) return text;
  if (first.scope !== second.scope || !sameFlags(first.flags, second.flags)) return text;
  if (text.slice(first.tail.end, second.head.start).trim() !== '') return text;
  if (!endsLine(text, second.head.end) || !startsLine(text, first.tail.start)) return text;
  return replaceRange(text, { start: lineStart(text, first.tail.start), end: nextLine(text, second.head.end) }, '');
}

/** Sets scope and flags of a row (DECL-26); neighbours keep theirs, alike blocks are joined. */
export function setScope(text: string, index: number, scope: string, flags: readonly string[]): string {
  const model = parseDeclaration(text);
  const row = editableRow(model, index);
  const block = model.blocks[row.block] as Block;
  if (block.frame !== 'variables') return text;
  if (block.scope === scope && sameFlags(block.flags, flags)) return text;
  if (row.shared > 1) return setScopeOfShared(text, index, scope, flags);
  const alone = isolate(text, index);
  const { head } = parseDeclaration(alone.text).blocks[alone.block] as Block;
  const changed = replaceRange(alone.text, head, headText(scope, flags));
  return joinWithNext(joinWithNext(changed, alone.block), alone.block - 1);
}

/** All names of one statement are in the same block, so they change together. */
function setScopeOfShared(text: string, index: number, scope: string, flags: readonly string[]): string {
  const model = parseDeclaration(text);
  const { statement } = model.rows[index] as Row;
  const group = model.rows.flatMap((row, i) => (row.statement === statement ? [i] : []));
  const first = group[0] as number;
  const last = group[group.length - 1] as number;
  let result = text;
  const next = model.rows[last + 1];
  const block = (model.rows[index] as Row).block;
  if (next !== undefined && next.block === block) result = splitBefore(result, last + 1);
  const previous = model.rows[first - 1];
  if (previous !== undefined && previous.block === block) result = splitBefore(result, first);
  const after = parseDeclaration(result);
  const own = (after.rows[first] as Row).block;
  const changed = replaceRange(result, (after.blocks[own] as Block).head, headText(scope, flags));
  return joinWithNext(joinWithNext(changed, own), own - 1);
}

export interface Moved {
  readonly text: string;
  /** Number of the row after the move; unchanged when it cannot move. */
  readonly row: number;
}

/** Moves a row one place up or down in the order of declaration (DECL-33). */
export function moveRow(text: string, index: number, direction: -1 | 1): Moved {
  const model = parseDeclaration(text);
  const other = index + direction;
  const row = model.rows[index];
  const neighbour = model.rows[other];
  if (row === undefined || neighbour === undefined) return { text, row: index };
  if (isTextPragma(row) || isTextPragma(neighbour)) return { text, row: index };
  if (row.statement === neighbour.statement) return { text: swapNames(text, row, neighbour), row: other };
  const mine = model.rows.filter((r) => r.statement === row.statement).length;
  const theirs = model.rows.filter((r) => r.statement === neighbour.statement).length;
  const upper = direction < 0 ? neighbour : row;
  const lower = direction < 0 ? row : neighbour;
  const target = index + direction * theirs;
  if (upper.block === lower.block) return { text: swapExtents(text, upper, lower), row: target };
  if (mine > 1 || theirs > 1) return { text, row: index };
  return { text: swapAcross(text, Math.min(index, other)), row: other };
}

/** Conditional pragmas act on what lies between them: nothing may jump over one. */
function isTextPragma(row: Row): boolean {
  return row.special?.startsWith('{') ?? false;
}

function swapNames(text: string, a: Row, b: Row): string {
  const [first, second] = a.name.start < b.name.start ? [a.name, b.name] : [b.name, a.name];
  return replaceRange(replaceRange(text, second, first.text), first, second.text);
}

/** Exchanges two neighbouring rows; the separators stay where they are, comments go with their row. */
function swapExtents(text: string, upper: Row, lower: Row): string {
  const a = pieces(text, upper);
  const b = pieces(text, lower);
  const gap = text.slice(extentOf(upper).end, extentOf(lower).start);
  const first = b.core + a.separator + b.trail;
  const second = a.core + b.separator + a.trail;
  const after = text.slice(extentOf(lower).end);
  const newline = lineBreakOf(text);
  const open = (part: string, following: string) =>
    endsWithLineComment(part) && !/^[ \t]*(?:\r?\n|$)/.test(following) ? newline : '';
  return (
    text.slice(0, extentOf(upper).start) +
    first + open(first, gap + second) + gap +
    second + open(second, after) + after
  ); // prettier-ignore
}

function pieces(text: string, row: Row): { core: string; separator: string; trail: string } {
  const { core, separator, trail } = row;
  return {
    core: text.slice(core.start, core.end),
    separator: separator === null ? '' : text.slice(core.end, separator.end),
    trail: text.slice(Math.max(core.end, separator?.end ?? core.end), Math.max(core.end, trail.end)),
  };
}

function endsWithLineComment(part: string): boolean {
  const line = part.slice(part.lastIndexOf('\n') + 1);
  return /\/\/[^\n]*$/.test(line);
}

/** Exchanges the last row of one block with the first of the next; each keeps its scope. */
function swapAcross(text: string, upper: number): string {
  const first = isolate(text, upper);
  const second = isolate(first.text, upper + 1);
  const { blocks } = parseDeclaration(second.text);
  const above = blocks[first.block] as Block;
  const below = blocks[second.block] as Block;
  let a: Range = { start: above.head.start, end: above.tail.end };
  let b: Range = { start: below.head.start, end: below.tail.end };
  const lines = [wholeLines(second.text, a), wholeLines(second.text, b)] as const;
  if (lines[0].end <= lines[1].start && second.text[lines[1].end - 1] === '\n') [a, b] = lines;
  const swapped = swapRanges(second.text, a, b);
  const places = new Set([second.block, second.block - 1, first.block, first.block - 1]);
  return [...places].sort((x, y) => y - x).reduce(joinWithNext, swapped);
}

function swapRanges(text: string, a: Range, b: Range): string {
  return (
    text.slice(0, a.start) +
    text.slice(b.start, b.end) +
    text.slice(a.end, b.start) +
    text.slice(a.start, a.end) +
    text.slice(b.end)
  );
}
