/** One statement of a block to its rows: which tokens are name, address, type, initial value, comment. */
import { textOf, type Token } from '../lexer';
import type { Cell, DeclarationProblem, ProblemKind, Range, Row } from './model';

/** Comments and pragmas in front of a declaration that belong to it. */
export interface Lead {
  readonly attributes: Cell[];
  readonly comments: Cell[];
  readonly start: number;
}

export interface Statement {
  readonly block: number;
  readonly number: number;
  /** Without comments and pragmas; at least one. */
  readonly tokens: readonly [Token, ...Token[]];
  readonly separator: Token | null;
  readonly lead: Lead;
  /** Comments and pragmas behind the separator in its line. */
  readonly trailing: readonly Token[];
}

export type StatementResult = { readonly rows: Row[] } | { readonly problem: DeclarationProblem };

export function cellOf(text: string, range: Range): Cell {
  return { start: range.start, end: range.end, text: text.slice(range.start, range.end) };
}

function failed(text: string, kind: ProblemKind, token: Token): StatementResult {
  return { problem: { kind, start: token.start, end: token.end, subject: textOf(text, token) } };
}

type RowBase = Omit<Row, 'shared' | 'name' | 'address' | 'type' | 'assign' | 'initial'>;

function baseOf(text: string, statement: Statement): RowBase {
  const { tokens, lead, separator, trailing } = statement;
  const last = tokens[tokens.length - 1] ?? tokens[0];
  const behind = trailing.filter((t) => t.kind === 'comment').map((t) => cellOf(text, t));
  const afterSeparator = (separator ?? last).end;
  return {
    block: statement.block,
    statement: statement.number,
    special: null,
    attributes: [...lead.attributes, ...trailing.filter((t) => t.kind === 'pragma').map((t) => cellOf(text, t))],
    comments: behind.length > 0 ? behind : lead.comments,
    commentsBehind: behind.length > 0,
    core: { start: lead.start, end: last.end },
    element: { start: tokens[0].start, end: last.end },
    separator: separator === null ? null : { start: separator.start, end: separator.end },
    trail: {
      start: trailing[0]?.start ?? afterSeparator,
      end: trailing[trailing.length - 1]?.end ?? afterSeparator,
    },
  };
}

/** A whole line of the text that the table shows but does not cut into cells. */
export function specialRow(text: string, block: number, number: number, token: Token): Row {
  const whole = cellOf(text, token);
  const range = { start: token.start, end: token.end };
  return {
    block,
    statement: number,
    shared: 1,
    special: whole.text,
    name: whole,
    address: null,
    type: null,
    assign: null,
    initial: null,
    attributes: [],
    comments: [],
    commentsBehind: false,
    core: range,
    element: range,
    separator: null,
    trail: { start: token.end, end: token.end },
  };
}

/** `name` or `name := value` of an enumeration. */
export function enumerationRow(text: string, statement: Statement): StatementResult {
  const [name, assign, value] = statement.tokens;
  if (name.kind !== 'word') return failed(text, 'unexpected', name);
  if (assign !== undefined && textOf(text, assign) !== ':=') return failed(text, 'unexpected', assign);
  const base = baseOf(text, statement);
  return {
    rows: [
      {
        ...base,
        shared: 1,
        name: cellOf(text, name),
        address: null,
        type: null,
        assign: assign === undefined ? null : cellOf(text, assign),
        initial: value === undefined ? null : cellOf(text, { start: value.start, end: base.element.end }),
      },
    ],
  };
}

/** `a, b AT %MW4 : type := value`: one row for each name (DECL-20). */
export function variableRows(text: string, statement: Statement): StatementResult {
  const reader = new StatementReader(text, statement.tokens);
  const base = baseOf(text, statement);
  const names = reader.names();
  if (names.length === 0) return failed(text, 'unexpected', statement.tokens[0]);
  if (reader.at('.')) {
    // VAR_CONFIG entries name whole instance paths (GVL-10): shown, not cut into cells.
    const whole = cellOf(text, base.element);
    const nothing = { address: null, type: null, assign: null, initial: null };
    return { rows: [{ ...base, ...nothing, shared: 1, special: whole.text, name: whole }] };
  }
  let address: Token | null = null;
  if (reader.at('AT')) {
    reader.take();
    address = reader.take();
  }
  const colon = reader.place();
  if (!reader.at(':')) return failed(text, 'missing-colon', colon);
  reader.take();
  const type = reader.until([':=', 'REF=']);
  if (type === null) return failed(text, 'missing-type', colon);
  const assign = reader.take();
  const initial = assign === null ? null : reader.until([]);
  const cells = {
    address: address && cellOf(text, address),
    type: cellOf(text, type),
    assign: assign && cellOf(text, assign),
    initial: initial && cellOf(text, initial),
  };
  return { rows: names.map((name) => ({ ...base, ...cells, shared: names.length, name: cellOf(text, name) })) };
}

class StatementReader {
  private index = 0;

  constructor(
    private readonly text: string,
    private readonly tokens: readonly [Token, ...Token[]],
  ) {}

  at(word: string): boolean {
    const token = this.tokens[this.index];
    return token !== undefined && textOf(this.text, token).toUpperCase() === word;
  }

  take(): Token | null {
    const token = this.tokens[this.index];
    if (token === undefined) return null;
    this.index += 1;
    return token;
  }

  /** The token that comes next, or the last one when there is none. */
  place(): Token {
    return this.tokens[Math.min(this.index, this.tokens.length - 1)] ?? this.tokens[0];
  }

  names(): Token[] {
    const found: Token[] = [];
    for (;;) {
      const token = this.tokens[this.index];
      if (token?.kind !== 'word') return found;
      found.push(token);
      this.index += 1;
      if (!this.at(',')) return found;
      this.index += 1;
    }
  }

  /** The range up to one of `stops` outside of brackets, or to the end; null when it is empty. */
  until(stops: readonly string[]): Range | null {
    const first = this.tokens[this.index];
    let last: Token | null = null;
    let depth = 0;
    for (; this.index < this.tokens.length; this.index += 1) {
      const token = this.tokens[this.index] as Token;
      const word = textOf(this.text, token).toUpperCase();
      if (depth === 0 && stops.includes(word)) break;
      if (word === '(' || word === '[') depth += 1;
      if (word === ')' || word === ']') depth -= 1;
      last = token;
    }
    return first === undefined || last === null ? null : { start: first.start, end: last.end };
  }
}
