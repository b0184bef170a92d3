/** Rows of IL, by their tokens: which words are operators, labels or functions and so name no value (IL-01, IL-13). */
import { textOf, type Token } from '@/iec/lexer';
import { BEGINNINGS, OPERATORS } from './operators';

const INSTRUCTIONS: ReadonlySet<string> = new Set(OPERATORS);
const FIRST: ReadonlySet<string> = new Set(BEGINNINGS);

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
  const rows = rowsOf(text, tokens)
    .map((row) => withoutLabel(text, row))
    .filter((row) => row.length > 0);
  const begins = (row: readonly Token[] | undefined, words: ReadonlySet<string>) => {
    const [first, second, third] = row ?? [];
    if (first === undefined || !words.has(textOf(text, first).toUpperCase())) return false;
    if (second === undefined) return textOf(text, first).toUpperCase().startsWith('RET');
    const behind = third === undefined ? '' : textOf(text, third);
    return behind !== '=' && behind !== ';' && (OPERANDS.has(second.kind) || textOf(text, second) === '-');
  };
  const alone = rows[0]?.length === 1 && rows[0][0]?.kind === 'word';
  return begins(rows[0], FIRST) || (alone && begins(rows[1], INSTRUCTIONS));
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
