/** Rows of IL, by their tokens: which words are operators, labels or functions and so name no value (IL-01, IL-13). */
import { textOf, type Token } from '@/iec/lexer';
import { CONSTANT_KEYWORDS, KEYWORDS } from '@/iec/grammar';
import { ALONE, CALLS, JUMPS, LOADS, OPERATORS } from './operators';

const INSTRUCTIONS: ReadonlySet<string> = new Set(OPERATORS);
const LOAD: ReadonlySet<string> = new Set(LOADS);
const CALL: ReadonlySet<string> = new Set(CALLS);
const JUMP: ReadonlySet<string> = new Set(JUMPS);
const STANDALONE: ReadonlySet<string> = new Set(ALONE);
const KEYWORD_SET: ReadonlySet<string> = new Set(KEYWORDS);
/** Keywords that are operands. */
const VALUES: ReadonlySet<string> = new Set([...CONSTANT_KEYWORDS, 'THIS', 'SUPER']);

/** Whether a word is an operator where one may stand. */
export function isOperator(word: string): boolean {
  return INSTRUCTIONS.has(word.toUpperCase());
}

const OPERANDS = new Set(['word', 'number', 'string', 'wstring', 'address']);

/** Tokens row by row; `tokens` are those without comments. */
function rowsOf(text: string, tokens: readonly Token[]): Token[][] {
  const rows: Token[][] = [];
  let before = 0;
  for (const token of tokens) {
    const row = rows.at(-1);
    if (row === undefined || text.slice(before, token.start).includes('\n')) rows.push([token]);
    else row.push(token);
    before = token.end;
  }
  return rows;
}

function withoutLabel(text: string, row: readonly Token[]): readonly Token[] {
  const [name, colon] = row;
  const labelled = name?.kind === 'word' && colon !== undefined && textOf(text, colon) === ':';
  return labelled ? row.slice(2) : row;
}

/** Whether a body is IL: by the standard the first instruction decides. `tokens` are those without comments. */
export function isInstructionList(text: string, tokens: readonly Token[]): boolean {
  const word = (at: number) => {
    const token = tokens[at];
    return token === undefined ? '' : textOf(text, token).toUpperCase();
  };
  const isName = (at: number) => tokens[at]?.kind === 'word' && !KEYWORD_SET.has(word(at));
  const isOperand = (at: number) => {
    const kind = tokens[at]?.kind;
    return kind === 'word' ? isName(at) || VALUES.has(word(at)) : kind !== undefined && OPERANDS.has(kind);
  };
  const endsRow = (at: number) => {
    const [token, next] = [tokens[at], tokens[at + 1]];
    return token === undefined || next === undefined || /[\r\n]/.test(text.slice(token.start, next.start));
  };
  const isRow = (at: number, hasValue: boolean) => {
    const operator = word(at);
    if (!INSTRUCTIONS.has(operator)) return false;
    if (endsRow(at)) return STANDALONE.has(operator);
    const behind = word(at + 2);
    if (behind === '=') return false;
    if (CALL.has(operator)) return isOperand(at + 1);
    if (JUMP.has(operator)) return isName(at + 1) && behind !== ';';
    if (LOAD.has(operator)) return isOperand(at + 1) || ['-', '+'].includes(word(at + 1));
    return hasValue && isOperand(at + 1) && behind !== ';';
  };
  let at = 0;
  // The first row may be the name of a function alone, such as TIME; then there is a value to go on with.
  for (const hasValue of [false, true]) {
    while (isName(at) && word(at + 1) === ':') at += 2;
    if (isRow(at, hasValue)) return true;
    if (!isName(at) || !endsRow(at)) return false;
    at += 1;
  }
  return false;
}

/** The tokens that may stand for values: without labels, operators, names of functions and targets of jumps. */
export function operandTokens(text: string, tokens: readonly Token[]): Token[] {
  let open = 0;
  return rowsOf(text, tokens).flatMap((row) => {
    const inside = open > 0;
    const call = /^CALC?N?$/i.test(textOf(text, withoutLabel(text, row)[0] ?? row[0]!));
    const depth = row.reduce((sum, token) => sum + bracket(textOf(text, token)), 0);
    // Parameters of a call go on over rows; a deferred operand is made of rows of its own.
    if (inside || call) open = Math.max(0, open + depth);
    if (inside) return row;
    const body = withoutLabel(text, row);
    const head = body[0];
    if (head?.kind !== 'word') return [...body];
    const word = textOf(text, head).toUpperCase();
    if (word.startsWith('JMP')) return [];
    let taken = 1;
    while (!isOperator(word) && isPath(text, body[taken])) taken += body[taken + 1]?.kind === 'word' ? 2 : 1;
    const opened = body[taken];
    // The parenthesis of a deferred operand belongs to the operator, not to the operand of the row before.
    if (opened !== undefined && textOf(text, opened) === '(') taken += 1;
    return body.slice(taken);
  });
}

function isPath(text: string, token: Token | undefined): boolean {
  return token !== undefined && ['.', '^'].includes(textOf(text, token));
}

function bracket(word: string): number {
  return word === '(' ? 1 : word === ')' ? -1 : 0;
}
