/** Small operations on ranges of the declaration text that the edits are made of. */

import { lineBreakOf, type Range } from './model';

export function replaceRange(text: string, range: Range, by: string): string {
  return text.slice(0, range.start) + by + text.slice(range.end);
}

export function lineStart(text: string, at: number): number {
  return text.lastIndexOf('\n', at - 1) + 1;
}

/** Offset of the line break that ends the line of `at`, or the length of the text. */
function lineEnd(text: string, at: number): number {
  const newline = text.indexOf('\n', at);
  if (newline < 0) return text.length;
  return text[newline - 1] === '\r' && newline > at ? newline - 1 : newline;
}

/** Offset of the first character of the line after the one of `at`. */
export function nextLine(text: string, at: number): number {
  const newline = text.indexOf('\n', at);
  return newline < 0 ? text.length : newline + 1;
}

/** White space in front of `at` in its line, or the indentation of that line when other text stands before. */
export function indentationAt(text: string, at: number): string {
  return /^[ \t]*/.exec(text.slice(lineStart(text, at), at))?.[0] ?? '';
}

export function startsLine(text: string, at: number): boolean {
  return text.slice(lineStart(text, at), at).trim() === '';
}

export function endsLine(text: string, at: number): boolean {
  return text.slice(at, lineEnd(text, at)).trim() === '';
}

/** Whole lines of `range` with their last line break, or just the range when it shares lines with other text. */
export function wholeLines(text: string, range: Range): Range {
  if (!startsLine(text, range.start) || !endsLine(text, range.end)) return range;
  return { start: lineStart(text, range.start), end: nextLine(text, range.end) };
}

/** Removes `range`, with its lines when nothing else stands in them, else with one blank next to it. */
export function removeRange(text: string, range: Range): string {
  const lines = wholeLines(text, range);
  if (lines.start !== range.start || lines.end !== range.end) {
    const atEnd = lines.end === text.length && !text.endsWith('\n') && lines.start > 0;
    if (!atEnd) return replaceRange(text, lines, '');
    const before = lines.start - lineBreakOf(text).length;
    return replaceRange(text, { start: before, end: lines.end }, '');
  }
  let { start, end } = range;
  if (/[ \t]/.test(text[start - 1] ?? '')) start -= 1;
  else if (/[ \t]/.test(text[end] ?? '')) end += 1;
  return text.slice(0, start) + text.slice(end);
}

export interface TextChange extends Range {
  readonly text: string;
}

/** The smallest single replacement that turns `before` into `after`, or null when they are equal. */
export function smallestChange(before: string, after: string): TextChange | null {
  if (before === after) return null;
  const shorter = Math.min(before.length, after.length);
  let head = 0;
  while (head < shorter && before[head] === after[head]) head += 1;
  let tail = 0;
  while (tail < shorter - head && before[before.length - 1 - tail] === after[after.length - 1 - tail]) {
    tail += 1;
  }
  return { start: head, end: before.length - tail, text: after.slice(head, after.length - tail) };
}
