/**
 * Which variables stand where in a body, and what to ask the runtime for to show their values (LST-87).
 *
 * Purely textual: the scope below says which names the shown instance has; every other name is taken for a
 * global one, and the server's answer decides (an expression it does not know gets no value).
 */
import { isConversion, isKeyword } from './keywords';
import { codeTokens, textOf, type Token } from './lexer';

export type IndexPart =
  | { readonly kind: 'number'; readonly value: number }
  /** `arr[i + 1]`: the value of another variable and a constant distance. */
  | { readonly kind: 'variable'; readonly path: AccessPath; readonly plus: number };

export type PathPart =
  | { readonly kind: 'name'; readonly name: string }
  | { readonly kind: 'index'; readonly indices: readonly IndexPart[] }
  | { readonly kind: 'bit'; readonly bit: number };

/** `inst.arr[i].x`, `.gVar`, `THIS^.x`; `own` is a name where it is declared, which stands for nothing else. */
export interface AccessPath {
  readonly root: 'plain' | 'global' | 'this' | 'own';
  readonly parts: readonly PathPart[];
}

export interface VariableUse {
  readonly start: number;
  /** Behind the last character of the path: here the value is shown. */
  readonly end: number;
  readonly path: AccessPath;
}

/**
 * All readable variable paths of a text, in order; calls, parameter names, labels and keywords are left out.
 * `tokens` are those of the text that may stand for values, without comments.
 */
export function findVariables(text: string, tokens: readonly Token[] = codeTokens(text)): VariableUse[] {
  return new PathFinder(text, tokens).run();
}

class PathFinder {
  private at = 0;
  private readonly found: VariableUse[] = [];
  /** For each open parenthesis: whether it encloses call arguments. */
  private readonly parens: boolean[] = [];

  constructor(
    private readonly text: string,
    private readonly tokens: readonly Token[],
  ) {}

  run(): VariableUse[] {
    while (this.at < this.tokens.length) this.step();
    return this.found.sort((a, b) => a.start - b.start);
  }

  private word(ahead = 0): string {
    const token = this.tokens[this.at + ahead];
    return token === undefined ? '' : textOf(this.text, token);
  }

  private kind(ahead = 0): string {
    return this.tokens[this.at + ahead]?.kind ?? '';
  }

  private step(): void {
    const word = this.word();
    if (word === '(') this.parens.push(this.kind(-1) === 'word' && !isKeyword(this.word(-1)));
    else if (word === ')') this.parens.pop();
    else if (this.kind() === 'address') {
      const token = this.tokens[this.at] as Token;
      const parts: PathPart[] = [{ kind: 'name', name: word }];
      if (!word.includes('*')) this.found.push({ start: token.start, end: token.end, path: { root: 'global', parts } });
    } else if (this.startsPath()) {
      this.pathAt();
      return;
    }
    this.at += 1;
  }

  private startsPath(): boolean {
    if (this.kind() !== 'word') return this.word() === '.' && this.globalDot();
    const word = this.word();
    const upper = word.toUpperCase();
    if (upper === 'THIS' || upper === 'SUPER') return this.word(1) === '^';
    if (upper === 'JMP') {
      this.at += 1; // the label behind it is no variable
      return false;
    }
    return !isKeyword(word) && !isConversion(word);
  }

  /** `.name` denotes a global one when nothing stands before the dot that it could belong to (LDEC-13). */
  private globalDot(): boolean {
    if (this.kind(1) !== 'word') return false;
    const before = this.word(-1);
    return !(this.kind(-1) === 'word' && !isKeyword(before)) && ![')', ']', '^'].includes(before);
  }

  /** Reads one path from here; records it when it stands for a value. */
  private pathAt(): void {
    const start = (this.tokens[this.at] as Token).start;
    const first = this.at;
    const path = this.readPath();
    if (path === null) return;
    const last = this.tokens[this.at - 1] as Token;
    const next = this.word();
    if (next === '(') return;
    const argument =
      this.parens[this.parens.length - 1] === true && ['(', ','].includes(this.word(first - 1 - this.at));
    if (argument && (next === ':=' || next === '=>')) return;
    const statementStart = ['', ';', 'THEN', 'ELSE', 'DO', 'REPEAT', 'OF'].includes(
      this.word(first - 1 - this.at).toUpperCase(),
    );
    if (next === ':' && statementStart && path.parts.length === 1) return;
    this.found.push({ start, end: last.end, path });
  }

  /** Null when the path holds something whose place is not fixed (a dereferenced pointer, a call in an index). */
  private readPath(): AccessPath | null {
    let root: AccessPath['root'] = 'plain';
    const parts: PathPart[] = [];
    const upper = this.word().toUpperCase();
    let usable = true;
    if (upper === 'THIS' || upper === 'SUPER') {
      root = 'this';
      this.at += 2;
    } else if (this.word() === '.') {
      root = 'global';
    } else {
      parts.push({ kind: 'name', name: this.word() });
      this.at += 1;
    }
    for (;;) {
      if (this.word() === '.' && this.kind(1) === 'word') {
        parts.push({ kind: 'name', name: this.word(1) });
        this.at += 2;
      } else if (this.word() === '.' && /^\d+$/.test(this.word(1))) {
        parts.push({ kind: 'bit', bit: Number(this.word(1)) });
        this.at += 2;
      } else if (this.word() === '[') {
        const index = this.indices();
        if (index === null) usable = false;
        else parts.push(index);
      } else if (this.word() === '^') {
        usable = false;
        this.at += 1;
      } else break;
    }
    return usable && parts.length > 0 ? { root, parts } : null;
  }

  /** Reads `[...]`; variables inside it are recorded on their own. */
  private indices(): PathPart | null {
    const open = this.at;
    let close = open + 1;
    for (let depth = 1; close < this.tokens.length; close += 1) {
      const word = textOf(this.text, this.tokens[close] as Token);
      if (word === '[') depth += 1;
      if (word === ']') depth -= 1;
      if (depth === 0 || word === ';') break;
    }
    this.at = open + 1;
    const parts: IndexPart[] = [];
    let usable = true;
    while (this.at < close) {
      const part = this.index(close);
      if (part === null) {
        usable = false;
        while (this.at < close && this.word() !== ',') this.step();
      } else parts.push(part);
      if (this.word() === ',') this.at += 1;
    }
    this.at = Math.min(close + 1, this.tokens.length);
    return usable && parts.length > 0 ? { kind: 'index', indices: parts } : null;
  }

  private index(close: number): IndexPart | null {
    const number = this.wholeNumber();
    if (number !== null) return { kind: 'number', value: number };
    if (!this.startsPath()) return null;
    const from = this.found.length;
    const start = (this.tokens[this.at] as Token).start;
    const path = this.readPath();
    if (path === null || this.word() === '(') return null;
    this.found.splice(from, 0, { start, end: (this.tokens[this.at - 1] as Token).end, path });
    const sign = this.word();
    if (this.at < close && (sign === '+' || sign === '-')) {
      const back = this.at;
      this.at += 1;
      const plus = this.wholeNumber();
      if (plus === null) {
        this.at = back;
        return null;
      }
      return { kind: 'variable', path, plus: sign === '-' ? -plus : plus };
    }
    return this.word() === ',' || this.at === close ? { kind: 'variable', path, plus: 0 } : null;
  }

  /** Takes a number that ends the index; null, and nothing taken, for anything else. */
  private wholeNumber(): number | null {
    const negative = this.word() === '-';
    const text = this.word(negative ? 1 : 0);
    const behind = this.word(negative ? 2 : 1);
    if (!/^\d+$/.test(text) || (behind !== ',' && behind !== ']')) return null;
    this.at += negative ? 2 : 1;
    return negative ? -Number(text) : Number(text);
  }
}

/** Names the shown instance answers to, by upper-case name; null while they are not known. */
export interface MonitorScope {
  /** `PLC_PRG`, `PLC_PRG.fbFiller1`; null where no instance is chosen, or for globals. */
  readonly instance: string | null;
  /** Members of the instance, inherited ones included. */
  readonly members: ReadonlySet<string> | null;
  /** Variables that live on the stack of a function or method: they have no value between calls. */
  readonly temporary: ReadonlySet<string>;
}

/** The present value of another variable, for indices that are variables. */
export type IndexValue = (expression: string) => number | null;

/** Expression that asks for the path in this scope; null when it cannot have a value. */
export function expressionOf(path: AccessPath, scope: MonitorScope, indexValue: IndexValue): string | null {
  const base = rootOf(path, scope);
  if (base === null) return null;
  let text = base;
  for (const part of path.parts) {
    if (part.kind === 'name') text += text === '' ? part.name : `.${part.name}`;
    else if (part.kind === 'bit') text += `.${String(part.bit)}`;
    else {
      const indices = part.indices.map((index) => indexNumber(index, scope, indexValue));
      if (indices.some((index) => index === null)) return null;
      text += `[${indices.join(', ')}]`;
    }
  }
  return text;
}

function rootOf(path: AccessPath, scope: MonitorScope): string | null {
  if (path.root === 'global') return '';
  if (path.root === 'this') return scope.instance;
  const first = path.parts[0];
  const name = first?.kind === 'name' ? first.name.toUpperCase() : '';
  if (scope.temporary.has(name)) return null;
  if (scope.members?.has(name)) return scope.instance;
  return path.root === 'own' ? null : '';
}

function indexNumber(index: IndexPart, scope: MonitorScope, indexValue: IndexValue): number | null {
  if (index.kind === 'number') return index.value;
  const expression = expressionOf(index.path, scope, indexValue);
  const value = expression === null ? null : indexValue(expression);
  return value === null ? null : value + index.plus;
}

/** Expressions of index variables inside a path: they must be watched for the path to be known. */
export function indexExpressions(path: AccessPath, scope: MonitorScope, indexValue: IndexValue): string[] {
  return path.parts.flatMap((part) =>
    part.kind !== 'index'
      ? []
      : part.indices.flatMap((index) => {
          if (index.kind === 'number') return [];
          const own = expressionOf(index.path, scope, indexValue);
          return [...indexExpressions(index.path, scope, indexValue), ...(own === null ? [] : [own])];
        }),
  );
}
