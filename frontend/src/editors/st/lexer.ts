/**
 * A tolerant tokenizer of IEC 61131-3 Structured Text, by character offsets.
 *
 * The editors need the places of things in a text while it is being typed: the declaration table edits cells
 * in place, monitoring puts values behind variables. It never fails; what it does not know becomes `other`.
 */
import { NUMERIC_TYPES } from './keywords';

export type TokenKind =
  | 'word' // identifier or keyword
  | 'number' // 12, 16#FF, 3.5e-2, INT#7, T#1s500ms, DT#2024-01-01-00:00:00
  | 'string' // 'abc'
  | 'wstring' // "abc"
  | 'address' // %IX0.0, %Q*
  | 'operator'
  | 'comment'
  | 'pragma'
  | 'other';

export interface Token {
  readonly kind: TokenKind;
  /** Offset of the first character. */
  readonly start: number;
  /** Offset behind the last character. */
  readonly end: number;
}

const WORD_START = /[A-Za-z_\u0080-\uffff]/;
const SPACE = /\s/;
const LONG_OPERATORS = ['REF=', ':=', '=>', '<=', '>=', '<>', '..', '**'];

// Sticky, so that each is tried at one place without slicing the text.
const WORD = /[A-Za-z_\u0080-\uffff][A-Za-z0-9_\u0080-\uffff]*/y;
const TYPED_VALUE = /#(?:[+-]?[0-9A-Za-z_]+(?:[.:-][0-9A-Za-z_]+)*|'(?:\$.|[^'$\r\n])*'|[A-Za-z_][A-Za-z0-9_]*)/y;
const TIME_VALUE = /#[-+]?[0-9][0-9A-Za-z_]*(?:\.[0-9][0-9A-Za-z_]*)*/y;
const DATE_VALUE = /#[0-9][0-9_]*(?:[-:.][0-9][0-9_]*)*/y;
const NUMERIC_VALUE =
  /#[-+]?(?:[0-9]+#[0-9A-Fa-f_]+|[0-9][0-9_]*(?:\.[0-9][0-9_]*)?(?:[eE][+-]?[0-9]+)?|TRUE\b|FALSE\b)/iy;
const NUMBER = /[0-9][0-9_]*(?:#[0-9A-Fa-f_]+|(?:\.(?!\.)[0-9][0-9_]*)?(?:[eE][+-]?[0-9]+)?)/y;
const ADDRESS = /%[IQMiqm](?:\*|[XBWDLxbwdl]?[0-9]+(?:\.[0-9]+)*)/y;

const TIME_PREFIXES = new Set(['T', 'TIME', 'LT', 'LTIME']);
const DATE_PREFIXES = new Set([
  'D',
  'DATE',
  'LD',
  'LDATE',
  'TOD',
  'TIME_OF_DAY',
  'LTOD',
  'LTIME_OF_DAY',
  'DT',
  'DATE_AND_TIME',
  'LDT',
  'LDATE_AND_TIME',
]);
const NUMERIC_PREFIXES: ReadonlySet<string> = new Set(NUMERIC_TYPES);

/** End of the match of a sticky expression at `at`, or -1. */
function matchAt(expression: RegExp, text: string, at: number): number {
  expression.lastIndex = at;
  return expression.test(text) ? expression.lastIndex : -1;
}

/** `(* ... *)` may be nested (LST-02); an open one reaches to the end of the text. */
function blockCommentEnd(text: string, start: number): number {
  let depth = 0;
  let at = start;
  while (at < text.length) {
    if (text.startsWith('(*', at)) {
      depth += 1;
      at += 2;
    } else if (text.startsWith('*)', at)) {
      depth -= 1;
      at += 2;
      if (depth === 0) return at;
    } else {
      at += 1;
    }
  }
  return text.length;
}

function lineEnd(text: string, start: number): number {
  for (let at = start; at < text.length; at += 1) {
    const c = text[at];
    if (c === '\n' || c === '\r') return at;
  }
  return text.length;
}

/** A pragma ends at its brace in the same line (LPRG-01); quoted braces inside do not count. */
function pragmaEnd(text: string, start: number): number {
  let quoted = false;
  for (let at = start; at < text.length; at += 1) {
    const c = text[at];
    if (c === '\n' || c === '\r') return at;
    if (c === "'") quoted = !quoted;
    if (c === '}' && !quoted) return at + 1;
  }
  return text.length;
}

function quotedEnd(text: string, start: number, quote: string): number {
  let at = start + 1;
  while (at < text.length) {
    const c = text[at];
    if (c === '\n' || c === '\r') return at;
    if (c === '$') at += 2;
    else if (c === quote) return at + 1;
    else at += 1;
  }
  return Math.min(at, text.length);
}

/** End of a literal with type prefix (`INT#7`, `T#1s`), or -1 when `#` starts something else. */
function typedLiteralEnd(text: string, prefix: string, hash: number): number {
  const upper = prefix.toUpperCase();
  if (TIME_PREFIXES.has(upper)) return matchAt(TIME_VALUE, text, hash);
  if (DATE_PREFIXES.has(upper)) return matchAt(DATE_VALUE, text, hash);
  if (NUMERIC_PREFIXES.has(upper)) return matchAt(NUMERIC_VALUE, text, hash);
  return matchAt(TYPED_VALUE, text, hash);
}

function next(text: string, at: number): Token {
  const c = text.charAt(at);
  const pair = text.slice(at, at + 2);
  if (pair === '(*') return { kind: 'comment', start: at, end: blockCommentEnd(text, at) };
  if (pair === '//') return { kind: 'comment', start: at, end: lineEnd(text, at) };
  if (c === '{') return { kind: 'pragma', start: at, end: pragmaEnd(text, at) };
  if (c === "'") return { kind: 'string', start: at, end: quotedEnd(text, at, "'") };
  if (c === '"') return { kind: 'wstring', start: at, end: quotedEnd(text, at, '"') };
  if (c === '%') {
    const end = matchAt(ADDRESS, text, at);
    return end < 0 ? { kind: 'other', start: at, end: at + 1 } : { kind: 'address', start: at, end };
  }
  if (c >= '0' && c <= '9') return { kind: 'number', start: at, end: matchAt(NUMBER, text, at) };
  for (const operator of LONG_OPERATORS) {
    if (text.slice(at, at + operator.length).toUpperCase() === operator) {
      return { kind: 'operator', start: at, end: at + operator.length };
    }
  }
  if (WORD_START.test(c)) {
    const end = matchAt(WORD, text, at);
    if (text[end] === '#') {
      const literalEnd = typedLiteralEnd(text, text.slice(at, end), end);
      if (literalEnd > 0) return { kind: 'number', start: at, end: literalEnd };
    }
    return { kind: 'word', start: at, end };
  }
  return { kind: '+-*/=<>()[],;:.^&#'.includes(c) ? 'operator' : 'other', start: at, end: at + 1 };
}

/** All tokens of `text`, comments and pragmas included, white space left out. */
export function tokenize(text: string): Token[] {
  const tokens: Token[] = [];
  let at = 0;
  while (at < text.length) {
    if (SPACE.test(text.charAt(at))) {
      at += 1;
      continue;
    }
    const token = next(text, at);
    tokens.push(token);
    at = token.end;
  }
  return tokens;
}

/** Whether comments and pragmas, which carry no program meaning by themselves. */
export function isTrivia(token: Token): boolean {
  return token.kind === 'comment' || token.kind === 'pragma';
}

/** The characters of a token. */
export function textOf(text: string, token: Token): string {
  return text.slice(token.start, token.end);
}
