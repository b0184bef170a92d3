/** Declaration text to header, blocks and rows with exact ranges. */

import { ACCESS_SPECIFIERS, ACCESSORS, BEGINNINGS, MODIFIERS, SECTION_FLAGS, SECTIONS } from '../grammar';
import { isTrivia, textOf, tokenize, type Token } from '../lexer';
import type {
  Block,
  Cell,
  DeclarationHeader,
  DeclarationModel,
  DeclarationProblem,
  ProblemKind,
  Range,
  Row,
} from './model';
import { cellOf, enumerationRow, specialRow, variableRows, type Lead } from './rows';

const HEADER_KEYWORDS: ReadonlySet<string> = new Set(BEGINNINGS);
const NAMELESS: ReadonlySet<string> = new Set(ACCESSORS);
const MODIFIER_WORDS: ReadonlySet<string> = new Set(MODIFIERS);
const FLAGS: ReadonlySet<string> = new Set(SECTION_FLAGS);
const ACCESS: ReadonlySet<string> = new Set(ACCESS_SPECIFIERS);
const SECTION_WORDS: ReadonlySet<string> = new Set(SECTIONS);
/** Pragmas that act on the text itself, not on one variable; no row may carry them along. */
const TEXT_PRAGMA = /^\{\s*(?:if|elsif|else|end_if|define|undefine|include|region|endregion)\b/i;

class DeclarationParser {
  private readonly tokens: Token[];
  private readonly blocks: Block[] = [];
  private readonly rows: Row[] = [];
  private readonly problems: DeclarationProblem[] = [];
  private header: DeclarationHeader | null = null;
  private listAttributes: Cell[] = [];
  private at = 0;
  private statements = 0;

  constructor(private readonly text: string) {
    this.tokens = tokenize(text);
  }

  parse(): DeclarationModel {
    let trivia: Token[] = [];
    while (this.at < this.tokens.length) {
      const token = this.peek();
      if (isTrivia(token)) {
        trivia.push(token);
        this.at += 1;
        continue;
      }
      const word = this.upper(token);
      if (token.kind === 'word' && SECTION_WORDS.has(word)) this.variableBlock(trivia);
      else if (token.kind === 'word' && word === 'TYPE') this.typeDeclaration(trivia);
      else if (token.kind === 'word' && HEADER_KEYWORDS.has(word) && this.header === null) this.pouHeader(trivia);
      else if (token.kind === 'word' && word.startsWith('END_')) this.at += 1;
      else if (this.textOf(token) === ';') this.at += 1;
      else {
        this.problem('unexpected', token, this.textOf(token));
        this.skipTo((t) => t.kind === 'word' && (SECTION_WORDS.has(this.upper(t)) || this.upper(t) === 'END_VAR'));
        if (this.at < this.tokens.length && this.upper(this.peek()) === 'END_VAR') this.at += 1;
      }
      trivia = [];
    }
    return {
      text: this.text,
      header: this.header,
      listAttributes: this.listAttributes,
      blocks: this.blocks,
      rows: this.rows,
      problems: this.problems,
    };
  }

  private peek(): Token {
    return this.tokens[this.at] as Token;
  }

  private textOf(token: Token): string {
    return textOf(this.text, token);
  }

  private upper(token: Token): string {
    return this.textOf(token).toUpperCase();
  }

  private cell(range: Range): Cell {
    return cellOf(this.text, range);
  }

  private problem(kind: ProblemKind, range: Range, subject: string): void {
    this.problems.push({ kind, start: range.start, end: range.end, subject });
  }

  private skipTo(stop: (token: Token) => boolean): void {
    while (this.at < this.tokens.length && !stop(this.peek())) this.at += 1;
  }

  private pouHeader(trivia: readonly Token[]): void {
    const keyword = this.peek();
    this.at += 1;
    const own: Token[] = [];
    while (this.at < this.tokens.length) {
      const token = this.peek();
      const word = this.upper(token);
      if (token.kind === 'word' && (SECTION_WORDS.has(word) || word.startsWith('END_'))) break;
      if (this.textOf(token) === ';') break;
      if (!isTrivia(token)) own.push(token);
      this.at += 1;
    }
    this.header = this.buildHeader(keyword, own, trivia);
  }

  private buildHeader(keyword: Token, own: readonly Token[], trivia: readonly Token[]): DeclarationHeader {
    let first = 0;
    while (first < own.length && MODIFIER_WORDS.has(this.upper(own[first] as Token))) first += 1;
    const name = own[first]?.kind === 'word' ? (own[first] as Token) : null;
    if (name === null && !NAMELESS.has(this.upper(keyword))) {
      this.problem('missing-name', keyword, this.textOf(keyword));
    }
    const extendsAt = own.findIndex((t) => this.upper(t) === 'EXTENDS');
    const colonAt = own.findIndex((t) => this.textOf(t) === ':');
    const last = own[own.length - 1];
    const base = extendsAt >= 0 ? own[extendsAt + 1] : undefined;
    const returnStart = colonAt >= 0 ? own[colonAt + 1] : undefined;
    return {
      keyword: this.cell(keyword),
      name: name === null ? null : this.cell(name),
      range: { start: keyword.start, end: (last ?? keyword).end },
      base: base === undefined ? null : this.cell(base),
      returnType:
        returnStart === undefined || last === undefined ? null : this.cell({ start: returnStart.start, end: last.end }),
      attributes: trivia.filter((t) => t.kind === 'pragma').map((t) => this.cell(t)),
      comments: trivia.filter((t) => t.kind === 'comment').map((t) => this.cell(t)),
    };
  }

  private variableBlock(trivia: readonly Token[]): void {
    if (this.header === null && this.blocks.length === 0) {
      this.listAttributes = trivia.filter((t) => t.kind === 'pragma').map((t) => this.cell(t));
    }
    const scope = this.peek();
    this.at += 1;
    let headEnd = scope.end;
    const flags: string[] = [];
    for (let ahead = this.at; ahead < this.tokens.length; ahead += 1) {
      const token = this.tokens[ahead] as Token;
      if (isTrivia(token)) continue;
      if (token.kind !== 'word' || !(FLAGS.has(this.upper(token)) || this.isAccess(ahead))) break;
      flags.push(this.upper(token));
      headEnd = token.end;
      this.at = ahead + 1;
    }
    const head = { start: scope.start, end: headEnd };
    this.rowsUntil(
      { frame: 'variables', scope: this.upper(scope), flags, head, tail: head },
      (word) => word === 'END_VAR',
      (word) => SECTION_WORDS.has(word),
    );
  }

  /** Whether an access specifier stands here, and not a variable of that name. */
  private isAccess(at: number): boolean {
    if (!ACCESS.has(this.upper(this.tokens[at] as Token))) return false;
    const next = this.tokens.slice(at + 1).find((token) => !isTrivia(token));
    return next?.kind === 'word' && this.upper(next) !== 'AT';
  }

  private typeDeclaration(trivia: readonly Token[]): void {
    const keyword = this.peek();
    this.at += 1;
    const own: Token[] = [];
    while (this.at < this.tokens.length && this.textOf(this.peek()) !== ':') {
      if (this.upper(this.peek()) === 'END_TYPE') break;
      if (!isTrivia(this.peek())) own.push(this.peek());
      this.at += 1;
    }
    this.header = this.buildHeader(keyword, own, trivia);
    if (this.at >= this.tokens.length || this.textOf(this.peek()) !== ':') {
      this.problem('missing-colon', own[own.length - 1] ?? keyword, ':');
      return;
    }
    this.at += 1;
    this.skipTo((t) => !isTrivia(t));
    if (this.at >= this.tokens.length || SECTION_WORDS.has(this.upper(this.peek()))) {
      this.problem('missing-type', keyword, '');
      return;
    }
    const opening = this.peek();
    const word = this.upper(opening);
    if (word === 'STRUCT' || word === 'UNION') {
      this.at += 1;
      this.rowsUntil(
        { frame: 'members', scope: word, flags: [], head: opening, tail: opening },
        (w) => w === `END_${word}`,
        (w) => w === 'END_TYPE' || SECTION_WORDS.has(w),
      );
    } else if (word === '(') {
      this.at += 1;
      this.rowsUntil(
        { frame: 'enumeration', scope: '', flags: [], head: opening, tail: opening },
        (w) => w === ')',
        (w) => w === 'END_TYPE',
      );
    } else {
      this.problem('not-tabular', opening, this.textOf(opening));
    }
    const behind = (word: string) => word === 'END_TYPE' || word === 'TYPE' || SECTION_WORDS.has(word);
    this.skipTo((t) => t.kind === 'word' && behind(this.upper(t)));
  }

  /** Reads statements up to the closing word and adds the block and its rows. */
  private rowsUntil(block: Block, closes: (word: string) => boolean, breaks: (word: string) => boolean): void {
    const number = this.blocks.length;
    this.blocks.push(block);
    let lead = this.headLineTrivia(block.head.end);
    let tail: Range | null = null;
    while (this.at < this.tokens.length) {
      const token = this.peek();
      if (isTrivia(token)) {
        this.at += 1;
        if (token.kind === 'pragma' && TEXT_PRAGMA.test(this.textOf(token))) {
          this.statements += 1;
          this.rows.push(specialRow(this.text, number, this.statements, token));
          lead = [];
        } else {
          lead.push(token);
        }
        continue;
      }
      const word = this.upper(token);
      if (closes(word)) {
        tail = token;
        this.at += 1;
        break;
      }
      if (breaks(word)) break;
      this.statement(number, block, this.leadOf(lead, token), closes, breaks);
      lead = [];
    }
    if (tail === null) {
      this.problem('missing-end', block.head, this.text.slice(block.head.start, block.head.end));
      const end = this.tokens[this.at - 1]?.end ?? this.text.length;
      tail = { start: end, end };
    }
    this.blocks[number] = { ...block, tail };
  }

  /** Comments in the line of `VAR` speak of the block; they belong to no row. */
  private headLineTrivia(headEnd: number): Token[] {
    while (this.at < this.tokens.length && isTrivia(this.peek())) {
      if (/[\r\n]/.test(this.text.slice(headEnd, this.peek().start))) break;
      const rest = this.tokens[this.at + 1];
      const alone = rest === undefined || /[\r\n]/.test(this.text.slice(this.peek().end, rest.start));
      if (!alone && this.peek().kind === 'pragma') break;
      this.at += 1;
    }
    return [];
  }

  private leadOf(tokens: readonly Token[], element: Token): Lead {
    const attributes: Cell[] = [];
    const comments: Cell[] = [];
    let start = element.start;
    let index = tokens.length - 1;
    let below = element.start;
    for (; index >= 0; index -= 1) {
      const token = tokens[index] as Token;
      const gap = this.text.slice(token.end, below);
      const blankLine = (gap.match(/\n/g)?.length ?? 0) > 1;
      if (token.kind === 'pragma') {
        attributes.unshift(this.cell(token));
      } else {
        if (blankLine && !tokens.slice(0, index).some((t) => t.kind === 'pragma')) break;
        if (!blankLine && start === below) comments.unshift(this.cell(token));
      }
      start = token.start;
      below = token.start;
    }
    return { attributes, comments, start };
  }

  private statement(
    number: number,
    block: Block,
    lead: Lead,
    closes: (word: string) => boolean,
    breaks: (word: string) => boolean,
  ): void {
    const enumeration = block.frame === 'enumeration';
    const tokens: Token[] = [];
    let separator: Token | null = null;
    let depth = 0;
    while (this.at < this.tokens.length) {
      const token = this.peek();
      const plain = this.textOf(token);
      const word = plain.toUpperCase();
      if (depth === 0 && (plain === ';' || (enumeration && plain === ','))) {
        separator = token;
        this.at += 1;
        break;
      }
      if (depth === 0 && enumeration && plain === ')') break;
      if (token.kind === 'word' && (closes(word) || breaks(word))) break;
      if (plain === '(' || plain === '[') depth += 1;
      if (plain === ')' || plain === ']') depth = Math.max(0, depth - 1);
      if (!isTrivia(token)) tokens.push(token);
      this.at += 1;
    }
    const [first, ...rest] = tokens;
    if (first === undefined) {
      if (separator !== null && enumeration) this.problem('unexpected', separator, this.textOf(separator));
      return;
    }
    const last = rest[rest.length - 1] ?? first;
    if (separator === null) this.at = this.tokens.indexOf(last) + 1;
    if (separator === null && !enumeration) {
      this.problem('missing-semicolon', last, this.textOf(last));
    }
    this.statements += 1;
    const statement = {
      block: number,
      number: this.statements,
      tokens: [first, ...rest] as const,
      separator,
      lead,
      trailing: this.trailing((separator ?? last).end),
    };
    const result = enumeration ? enumerationRow(this.text, statement) : variableRows(this.text, statement);
    if ('problem' in result) this.problems.push(result.problem);
    else this.rows.push(...result.rows);
  }

  /** Trivia behind the separator that begins in its line. */
  private trailing(end: number): Token[] {
    const found: Token[] = [];
    let from = end;
    while (this.at < this.tokens.length && isTrivia(this.peek())) {
      const token = this.peek();
      if (/[\r\n]/.test(this.text.slice(from, token.start))) break;
      if (token.kind === 'pragma' && TEXT_PRAGMA.test(this.textOf(token))) break;
      found.push(token);
      from = token.end;
      this.at += 1;
      if (this.text.slice(token.start, token.end).includes('\n')) break;
    }
    return found;
  }
}

/** Reads the declaration part of any object; never throws, problems are listed in the result. */
export function parseDeclaration(text: string): DeclarationModel {
  return new DeclarationParser(text).parse();
}
