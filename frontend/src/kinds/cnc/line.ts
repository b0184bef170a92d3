/**
 * One block of a DIN 66025 program as it is written: its words and where they stand (cnc.md GC-01 to GC-09).
 *
 * Reading is tolerant: what is no word stays as a token, and the tokens of a line always make up its text again.
 */

export type Value =
  | { readonly kind: 'number'; readonly number: number }
  /** `$GVL.x$`: the value of an IEC variable. */
  | { readonly kind: 'variable'; readonly name: string }
  /** `#x` or `{...}`: what only the online interpreter computes (VAR-05, VAR-06). */
  | { readonly kind: 'expression' }
  | { readonly kind: 'none' };

/** Places are characters of the line, from 0; `end` is behind the last one. */
export interface Token {
  readonly kind: 'blank' | 'skip' | 'header' | 'word' | 'comment' | 'statement' | 'other';
  readonly at: number;
  readonly end: number;
}

export interface Word extends Token {
  readonly kind: 'word';
  /** Letters in upper case: `G`, `X`, `FZ`, `PROBE`. */
  readonly address: string;
  readonly valueAt: number;
  readonly value: Value;
}

export interface Block {
  readonly text: string;
  readonly tokens: readonly (Token | Word)[];
  /** All words in their order, block number included. */
  readonly words: readonly Word[];
  /** Begins with `/` (GC-10). */
  readonly skip: boolean;
  /** Block number; null where there is none that can be one. */
  readonly number: number | null;
}

const NUMBER = /[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?/y;
const VARIABLE = /\$[^$]*\$/y;
const EXPRESSION = /[+-]?(?:#\w+|\{[^}]*\})(?:[*/+-](?:#\w+|\{[^}]*\}|\d+(?:\.\d*)?))*/y;
const ADDRESS = /PROBE|FF|EF|[FE][XYZABCPQUVW]|[A-Z]/iy;
const STATEMENT = /(?:LET|SUBPROGRAM|END_SUBPROGRAM|RETURN)\b.*|[A-Z_]\w+\s*\{.*/iy;
const BLANK = /[^\S\n]+/y;
const COMMENT = /\([^)]*\)?|\/\/.*/y;
const OTHER = /[^\sA-Za-z(/]+|./y;

function matched(pattern: RegExp, text: string, at: number): string | null {
  pattern.lastIndex = at;
  return pattern.exec(text)?.[0] ?? null;
}

/** Reads one line, without its line break. */
export function readBlock(text: string): Block {
  const tokens: (Token | Word)[] = [];
  const words: Word[] = [];
  let skip = false;
  let at = 0;
  /** Nothing but blanks, a skip mark and a block number so far. */
  let beginning = true;
  const push = (kind: Exclude<Token['kind'], 'word'>, length: number) => {
    tokens.push({ kind, at, end: at + length });
    at += length;
  };
  while (at < text.length) {
    const blank = matched(BLANK, text, at);
    if (blank !== null) {
      push('blank', blank.length);
      continue;
    }
    const comment = matched(COMMENT, text, at);
    if (comment !== null) {
      push('comment', comment.length);
      continue;
    }
    if (beginning && words.length === 0 && !skip && text[at] === '/') {
      skip = true;
      push('skip', 1);
      continue;
    }
    if (beginning && words.length === 0 && !skip && text[at] === '%') {
      push('header', text.length - at);
      continue;
    }
    const statement = beginning ? matched(STATEMENT, text, at) : null;
    if (statement !== null) {
      push('statement', statement.length);
      continue;
    }
    const address = matched(ADDRESS, text, at);
    if (address === null) {
      push('other', (matched(OTHER, text, at) ?? text.slice(at)).length);
      continue;
    }
    const word = readWord(text, at, address);
    if (word.address !== 'N') beginning = false;
    tokens.push(word);
    words.push(word);
    at = word.end;
  }
  return { text, tokens, words, skip, number: numberOf(words) };
}

function readWord(text: string, at: number, address: string): Word {
  const valueAt = at + address.length;
  const made = (length: number, value: Value): Word => ({
    kind: 'word',
    at,
    end: valueAt + length,
    address: address.toUpperCase(),
    valueAt,
    value,
  });
  const variable = matched(VARIABLE, text, valueAt);
  if (variable !== null) return made(variable.length, { kind: 'variable', name: variable.slice(1, -1) });
  const number = matched(NUMBER, text, valueAt);
  if (number !== null) return made(number.length, { kind: 'number', number: Number(number) });
  const expression = matched(EXPRESSION, text, valueAt);
  if (expression !== null) return made(expression.length, { kind: 'expression' });
  return made(0, { kind: 'none' });
}

function numberOf(words: readonly Word[]): number | null {
  const word = words.find(({ address }) => address === 'N');
  return word?.value.kind === 'number' && isBlockNumber(word.value.number) ? word.value.number : null;
}

/** A block number is an unsigned integer (GC-02). */
export function isBlockNumber(value: number): boolean {
  return Number.isInteger(value) && value >= 0 && value <= 0xffffffff;
}

/** The first word of an address. */
export function wordOf(block: Block, address: string): Word | undefined {
  return block.words.find((word) => word.address === address);
}

/** The number of a word of the block; undefined where there is none, NaN where it is only known at run time. */
export function valueOf(block: Block, address: string): number | undefined {
  const value = wordOf(block, address)?.value;
  if (value === undefined || value.kind === 'none') return undefined;
  return value.kind === 'number' ? value.number : Number.NaN;
}

/** What is between parentheses or behind `//`, without either. */
export function commentOf(block: Block): string {
  return block.tokens
    .filter(({ kind }) => kind === 'comment')
    .map(({ at, end }) => block.text.slice(at, end).replace(/^\/\/\s*|^\(\s*|\s*\)$/g, ''))
    .join(' ');
}

/** A number as a program has it: no exponent, at most nine digits behind the point. */
export function numberWord(value: number): string {
  if (Math.abs(value) >= 1e15) return String(value);
  const text = value.toFixed(9).replace(/\.?0+$/, '');
  return text === '-0' ? '0' : text;
}
