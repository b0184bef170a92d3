/**
 * A tolerant tokenizer of IEC 61131-3 Structured Text, by character offsets.
 *
 * The editors need the places of things in a text while it is being typed: the declaration table edits cells
 * in place, monitoring puts values behind variables. It never fails; what it does not know becomes `other`.
 * The expression is that of the compiler; only `REF=` is one operator here.
 */
import { DIGIT, OPERATORS, QUOTED_OVER_LINES, TOKEN, WORD_CHARACTER } from './grammar';

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

const COMMENT_MARK = /\(\*|\*\)/g;
const SIGNS: ReadonlySet<string> = new Set(OPERATORS);

/** Where the comment ends whose `(*` is at `start`: comments nest (LST-02), an open one takes the rest. */
function blockCommentEnd(text: string, start: number): number {
  let depth = 0;
  COMMENT_MARK.lastIndex = start;
  for (let mark = COMMENT_MARK.exec(text); mark !== null; mark = COMMENT_MARK.exec(text)) {
    depth += mark[0] === '(*' ? 1 : -1;
    if (depth === 0) return COMMENT_MARK.lastIndex;
  }
  return text.length;
}

/** Whether the last quote closes a string, rather than being escaped by an odd number of `$`. */
function isClosed(quoted: string): boolean {
  if (quoted.length < 2 || quoted.at(-1) !== quoted[0]) return false;
  const dollars = /\$*$/.exec(quoted.slice(1, -1));
  return (dollars?.[0].length ?? 0) % 2 === 0;
}

/** End of a string without its quote in the line: where a later line has it, or the end of the line. */
function openStringEnd(text: string, start: number, piece: string): number {
  const lines = QUOTED_OVER_LINES[piece.charAt(0)];
  if (lines !== undefined) {
    lines.lastIndex = start;
    const match = lines.exec(text);
    const first = match?.[0].split('\n', 1)[0]?.trimEnd() ?? ';';
    if (match?.[1] !== undefined && !first.endsWith(';')) return start + match[1].length;
  }
  return start + piece.length;
}

function kindOf(piece: string): TokenKind {
  const first = String.fromCodePoint(piece.codePointAt(0) as number);
  if (WORD_CHARACTER.test(first)) return piece.includes('#') || DIGIT.test(first) ? 'number' : 'word';
  if (first === "'") return 'string';
  if (first === '"') return 'wstring';
  if (first === '{') return 'pragma';
  if (first === '%' && piece.length > 1) return 'address';
  if (/^(?:\(\*|\/\/|\/\*)/.test(piece)) return 'comment';
  return SIGNS.has(piece) ? 'operator' : 'other';
}

/** All tokens of `text`, comments and pragmas included, white space left out. */
export function tokenize(text: string): Token[] {
  const tokens: Token[] = [];
  TOKEN.lastIndex = 0;
  for (let match = TOKEN.exec(text); match !== null; match = TOKEN.exec(text)) {
    const piece = match[1] as string;
    if (piece.startsWith('\n') || piece.startsWith('\r')) continue;
    const kind = kindOf(piece);
    let end = TOKEN.lastIndex;
    const start = end - piece.length;
    const before = tokens.at(-1);
    if (piece === '(*') end = blockCommentEnd(text, start);
    else if ((kind === 'string' || kind === 'wstring') && !isClosed(piece)) end = openStringEnd(text, start, piece);
    TOKEN.lastIndex = end;
    if (piece === '=' && before?.end === start && /^REF$/i.test(textOf(text, before))) {
      tokens[tokens.length - 1] = { kind: 'operator', start: before.start, end };
    } else {
      tokens.push({ kind, start, end });
    }
  }
  return tokens;
}

/** Whether comments and pragmas, which carry no program meaning by themselves. */
export function isTrivia(token: Token): boolean {
  return token.kind === 'comment' || token.kind === 'pragma';
}

/** The tokens of `text` without comments and pragmas. */
export function codeTokens(text: string): Token[] {
  return tokenize(text).filter((token) => !isTrivia(token));
}

/** The characters of a token. */
export function textOf(text: string, token: Token): string {
  return text.slice(token.start, token.end);
}
