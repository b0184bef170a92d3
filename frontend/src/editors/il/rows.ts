/**
 * A body in IL as the rows of its table (IL-01). Rows only point into the text; together they cover all of it, so
 * nothing a text holds can be lost by showing it. Whether a row is right is said by the compiler.
 */
import { joinComments } from '@/iec/declaration/comments';
import type { Range } from '@/iec/declaration/model';
import { isOperator } from './instructionList';
import { isTrivia, textOf, tokenize, type Token } from '@/iec/lexer';
import { runsOf, type Run } from './excluded';

export type RowKind =
  /** Operator and operand. */
  | 'instruction'
  /** `name :=` or `name =>` and the actual value, inside the parentheses of a call (IL-14). */
  | 'parameter'
  /** Further operands of the row above (IL-11), or what closes a call. */
  | 'operand'
  /** Begins a network (IL-09); its instruction may stand in the same line. */
  | 'label'
  /** Comments, and nothing else (IL-10). */
  | 'comment'
  | 'blank'
  /** Pragmas, comments amid the row, characters that begin nothing: shown and edited as text. */
  | 'raw';

export interface Cell extends Range {
  readonly text: string;
}

export interface IlRow extends Range {
  readonly kind: RowKind;
  /** Line in which the row begins, from 1. */
  readonly line: number;
  /** Where its line begins. */
  readonly lineStart: number;
  /** First column: the operator, the label with its colon, the parameter with `:=`; all of a raw row. */
  readonly operator: Cell | null;
  readonly operand: Cell | null;
  /** Comments behind the row, with their delimiters. */
  readonly comment: Cell | null;
  /** How many parentheses are open around the row (IL-12). */
  readonly depth: number;
  /** Number of its network: a label begins a new one. */
  readonly network: number;
  /** Its network is commented out (NET-07). */
  readonly excluded: boolean;
}

export type IlColumn = 'operator' | 'operand' | 'comment';

type Opened = 'call' | 'deferred';

/** What the rows before mean for the next one. */
interface Context {
  opened: Opened[];
  continues: boolean;
  network: number;
  /** Whether the network has a row that does something. */
  begun: boolean;
}

/** Lines of a text without their line breaks; lines that one token ties together are one. */
export function segmentsOf(text: string, tokens: readonly Token[] = tokenize(text)): Range[] {
  const segments: Range[] = [];
  let start = 0;
  let next = 0;
  for (let at = text.indexOf('\n'); at >= 0; at = text.indexOf('\n', at + 1)) {
    while (next < tokens.length && (tokens[next] as Token).end <= at) next += 1;
    if (next < tokens.length && (tokens[next] as Token).start <= at) continue;
    segments.push({ start, end: at });
    start = at + 1;
  }
  segments.push({ start, end: text.length });
  return segments;
}

/** All rows of a body: one for each line, and one more for each label in front of an instruction. */
export function parseRows(text: string): readonly IlRow[] {
  const context: Context = { opened: [], continues: false, network: 1, begun: false };
  const rows: IlRow[] = [];
  let line = 1;
  for (const run of piecesOf(text)) {
    const { opened, continues } = context;
    if (run.excluded) Object.assign(context, { opened: [], continues: false });
    rows.push(...rowsOf(run, line, context));
    if (run.excluded) Object.assign(context, { opened, continues });
    line += run.bare.split('\n').length;
  }
  return rows;
}

function piecesOf(text: string): readonly Run[] {
  const tokens = tokenize(text);
  const comments = new Set(tokens.flatMap((token) => (token.kind === 'comment' ? [token.start] : [])));
  const mark = (at: number) => at + /^[ \t]*/.exec(text.slice(at))![0].length;
  return runsOf(text, segmentsOf(text, tokens), (segment) => comments.has(mark(segment.start)));
}

function rowsOf({ start: from, bare: text, excluded }: Run, firstLine: number, context: Context): IlRow[] {
  const tokens = tokenize(text);
  const code = tokens.filter((token) => !isTrivia(token));
  const rows: IlRow[] = [];
  let line = firstLine;
  let at = 0;
  let codeAt = 0;
  for (const segment of segmentsOf(text, tokens)) {
    const first = at;
    while (at < tokens.length && (tokens[at] as Token).start < segment.end) at += 1;
    const own = tokens.slice(first, at);
    const ownCode = own.filter((token) => !isTrivia(token));
    const body = { all: code, at: codeAt, from, excluded };
    rows.push(...new Line(text, segment, line, own, ownCode, body, context).rows());
    codeAt += ownCode.length;
    line += text.slice(segment.start, segment.end).split('\n').length;
  }
  return rows;
}

/** The piece of the text that a line is part of. */
interface Body {
  /** Its tokens, and where those of the line begin among them. */
  readonly all: readonly Token[];
  readonly at: number;
  /** Where it begins in the whole text. */
  readonly from: number;
  readonly excluded: boolean;
}

/** The rows of one line: labels, and what stands behind them. */
class Line {
  private taken = 0;
  private start: number;

  constructor(
    private readonly text: string,
    private readonly segment: Range,
    private readonly line: number,
    private readonly tokens: readonly Token[],
    private readonly code: readonly Token[],
    private readonly body: Body,
    private readonly context: Context,
  ) {
    this.start = segment.start;
  }

  rows(): IlRow[] {
    if (this.tokens.length === 0) return [this.row('blank', null, null, null)];
    const comment = this.trailingComment();
    if (comment === undefined) return [this.raw(this.tokens[0] as Token, this.tokens.at(-1) as Token, null)];
    if (this.code.length === 0) return [this.row('comment', null, null, comment)];
    const found: IlRow[] = [];
    if (this.context.opened.at(-1) !== 'call') {
      while (this.word(0) !== null && this.word(1) === ':') {
        const label = this.cell(this.taken, this.taken + 2);
        this.taken += 2;
        const alone = this.taken === this.code.length;
        if (this.context.begun) this.context.network += 1;
        this.context.begun = false;
        this.context.continues = false;
        found.push(this.row('label', label, null, alone ? comment : null, alone ? this.segment.end : label.end));
      }
    }
    if (this.taken < this.code.length) found.push(this.instruction(comment));
    return found;
  }

  /** Comments at the end of the line; null without any, undefined where comments or pragmas stand elsewhere. */
  private trailingComment(): Cell | null | undefined {
    const first = this.tokens.findIndex(isTrivia);
    if (first < 0) return null;
    const behind = this.tokens.slice(first);
    if (behind.some((token) => token.kind !== 'comment')) return undefined;
    return this.span(behind[0] as Token, behind.at(-1) as Token);
  }

  private instruction(comment: Cell | null): IlRow {
    const { context } = this;
    const first = this.taken;
    const inCall = context.opened.at(-1) === 'call';
    const depth = context.opened.length - (this.text[this.code[first]?.start ?? 0] === ')' ? 1 : 0);
    const end = this.code.length;
    context.begun = true;
    let kind: RowKind = 'instruction';
    let split: number;
    if (inCall || (context.continues && !this.beginsInstruction())) {
      const named = inCall && this.word(0) !== null && [':=', '=>'].includes(this.word(1) ?? '');
      kind = named ? 'parameter' : 'operand';
      split = named ? first + 2 : first;
    } else {
      split = this.operatorEnd();
    }
    this.count(first);
    if (split === first && kind === 'instruction')
      return this.raw(this.code[first] as Token, this.code.at(-1) as Token, comment, depth);
    const operator = split > first ? this.cell(first, split) : null;
    const operand = split < end ? this.cell(split, end) : null;
    return this.row(kind, operator, operand, comment, this.segment.end, depth);
  }

  /** Behind the last token of the operator column; where the row begins with none, its beginning. */
  private operatorEnd(): number {
    const first = this.taken;
    const lead = this.word(0) ?? this.textAt(first);
    if (lead === ')') return this.code.length === first + 1 ? first + 1 : first;
    if (lead !== '&' && this.word(0) === null) return first;
    let split = first + 1;
    const known = isOperator(lead) && this.textAt(split) !== '.';
    if (!known && lead !== '&') split = this.pathEnd(split);
    if (/^CALC?N?$/i.test(lead)) return split;
    // A parenthesis that closes in its row is the operand's; one that stays open belongs to the operator.
    const opens = this.textAt(split) === '(' && !this.isFormal(split) && this.closing(split) === null;
    return opens ? split + 1 : split;
  }

  /** Behind `.name`, `^` and `[...]` that go on a path. */
  private pathEnd(from: number): number {
    let at = from;
    for (;;) {
      if (this.textAt(at) === '.' && this.code[at + 1]?.kind === 'word') at += 2;
      else if (this.textAt(at) === '^') at += 1;
      else if (this.textAt(at) === '[') {
        const close = this.closing(at);
        if (close === null) return at;
        at = close + 1;
      } else return at;
    }
  }

  /** Token that closes the bracket at `from` in this line. */
  private closing(from: number): number | null {
    let level = 0;
    for (let at = from; at < this.code.length; at += 1) {
      const text = this.textAt(at);
      if (text === '(' || text === '[') level += 1;
      if (text === ')' || text === ']') level -= 1;
      if (level === 0) return at;
    }
    return null;
  }

  /** Whether the `(` here opens a list of named parameters, or an empty one. */
  private isFormal(at: number): boolean {
    const [first, second] = this.body.all.slice(this.body.at + at + 1, this.body.at + at + 3);
    if (first === undefined) return false;
    if (textOf(this.text, first) === ')') return true;
    return second !== undefined && [':=', '=>'].includes(textOf(this.text, second));
  }

  /** Whether an operator with an operand stands where an operand was to come. */
  private beginsInstruction(): boolean {
    const behind = this.textAt(this.taken + 1);
    return isOperator(this.word(0) ?? '') && !['', ',', '.'].includes(behind);
  }

  /** Takes the parentheses and the last comma of the row into the context. */
  private count(first: number): void {
    const { opened } = this.context;
    const call = /^CALC?N?$/i.test(this.textAt(first));
    for (let at = first; at < this.code.length; at += 1) {
      const text = this.textAt(at);
      if (text === '(') opened.push(call || opened.at(-1) === 'call' || this.isFormal(at) ? 'call' : 'deferred');
      if (text === ')') opened.pop();
    }
    this.context.continues = this.textAt(this.code.length - 1) === ',';
  }

  /** A word of the line, counted from what is not taken yet. */
  private word(ahead: number): string | null {
    const token = this.code[this.taken + ahead];
    if (token === undefined || (ahead === 0 && token.kind !== 'word')) return null;
    return textOf(this.text, token);
  }

  private textAt(index: number): string {
    const token = this.code[index];
    return token === undefined ? '' : textOf(this.text, token);
  }

  private cell(from: number, behind: number): Cell {
    return this.span(this.code[from] as Token, this.code[behind - 1] as Token);
  }

  private span(first: Token, last: Token): Cell {
    return { start: first.start, end: last.end, text: this.text.slice(first.start, last.end) };
  }

  private raw(first: Token, last: Token, comment: Cell | null, depth = this.context.opened.length): IlRow {
    return this.row('raw', this.span(first, last), null, comment, this.segment.end, depth);
  }

  private row(
    kind: RowKind,
    operator: Cell | null,
    operand: Cell | null,
    comment: Cell | null,
    end = this.segment.end,
    depth = this.context.opened.length,
  ): IlRow {
    const { start, line } = this;
    const { network } = this.context;
    const { from, excluded } = this.body;
    const placed = (cell: Cell | null) => cell && { ...cell, start: from + cell.start, end: from + cell.end };
    this.start = end;
    return {
      kind,
      line,
      lineStart: from + this.segment.start,
      start: from + start,
      end: from + end,
      operator: placed(operator),
      operand: placed(operand),
      comment: placed(comment),
      depth: Math.max(0, depth),
      network,
      excluded,
    };
  }
}

/** What a cell shows: comments without their delimiters. */
export function cellText(row: IlRow, column: IlColumn): string {
  if (column !== 'comment') return row[column]?.text ?? '';
  const comment = row.comment?.text ?? '';
  return joinComments(tokenize(comment).map((token) => textOf(comment, token)));
}

/** The row that holds a place of the text (line and column from 1), -1 without rows. */
export function rowAt(rows: readonly IlRow[], line: number, column = 1): number {
  let found = -1;
  rows.forEach((row, index) => {
    if (row.line > line) return;
    const begins = row.start - row.lineStart + 1;
    if (row.line < line || begins <= column || found < 0) found = index;
  });
  return found;
}
