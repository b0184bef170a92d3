/** Edits of the declaration header: keyword, name, comment and POU-wide attributes (DECL-22, DECL-30). */
import { attributeLines, writeAttributes } from './cells';
import { commentLines, joinComments } from './comments';
import { lineBreakOf, type Range } from './model';
import { parseDeclaration } from './parse';
import { removeRange, replaceRange } from './text';

export interface HeaderValues {
  readonly keyword: string;
  readonly name: string;
  readonly comment: string;
  readonly attributes: readonly string[];
}

/** Keywords an object may be turned into by editing its header; one that fits its place in the tree. */
export function keywordChoices(keyword: string): readonly string[] {
  const upper = keyword.toUpperCase();
  const pous = ['PROGRAM', 'FUNCTION_BLOCK', 'FUNCTION'];
  return pous.includes(upper) ? pous : [upper];
}

export function headerValues(text: string): HeaderValues | null {
  const { header } = parseDeclaration(text);
  if (header === null) return null;
  return {
    keyword: header.keyword.text.toUpperCase(),
    name: header.name?.text ?? '',
    comment: joinComments(header.comments.map((cell) => cell.text)),
    attributes: attributeLines(header),
  };
}

/** Writes the header; parts that are as they were stay untouched. A new FUNCTION gets a return type. */
export function setHeader(text: string, values: HeaderValues): string {
  const header = parseDeclaration(text).header;
  const before = headerValues(text);
  if (header === null || before === null) return text;
  let result = text;
  if (values.keyword !== before.keyword) {
    if (values.keyword === 'FUNCTION' && header.returnType === null) {
      result = replaceRange(result, { start: header.range.end, end: header.range.end }, ' : BOOL');
    } else if (values.keyword !== 'FUNCTION' && header.returnType !== null && header.name !== null) {
      result = replaceRange(result, { start: header.name.end, end: header.returnType.end }, '');
    }
  }
  if (header.name !== null && values.name !== before.name) result = replaceRange(result, header.name, values.name);
  if (values.keyword !== before.keyword) result = replaceRange(result, header.keyword, values.keyword);
  result = writeAttributes(result, header.attributes, before.attributes, values.attributes, header.keyword.start);
  return values.comment === before.comment ? result : setHeaderComment(result, values.comment);
}

/** Writes the pragmas of a whole variable list, in front of its first block. */
export function setListAttributes(text: string, lines: readonly string[]): string {
  const { listAttributes, blocks } = parseDeclaration(text);
  const first = blocks[0];
  if (first === undefined) return text;
  return writeAttributes(text, listAttributes, attributeLines({ attributes: listAttributes }), lines, first.head.start);
}

function setHeaderComment(text: string, comment: string): string {
  const header = parseDeclaration(text).header;
  if (header === null) return text;
  const newline = lineBreakOf(text);
  const ranges: readonly Range[] = header.comments;
  const first = ranges[0];
  const cleared = [...ranges.slice(first === undefined ? 0 : 1)].reduceRight<string>(removeRange, text);
  const lines = commentLines(comment).join(newline);
  if (first !== undefined) return comment === '' ? removeRange(cleared, first) : replaceRange(cleared, first, lines);
  if (comment === '') return cleared;
  const at = Math.min(header.keyword.start, header.attributes[0]?.start ?? header.keyword.start);
  return replaceRange(cleared, { start: at, end: at }, lines + newline);
}
