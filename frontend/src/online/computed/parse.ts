/** The tree of an expression, by the precedence of IEC 61131-3 Structured Text (LST-04). */
import { OPERATOR_KEYWORDS } from '@/iec/grammar';
import { codeTokens, textOf, type TokenKind } from '@/iec/lexer';
import { FUNCTIONS } from './operations';
import { elementaryNamed } from './types';

export type Tree =
  | { readonly kind: 'literal'; readonly text: string }
  | { readonly kind: 'text'; readonly text: string }
  | { readonly kind: 'variable'; readonly path: string }
  | { readonly kind: 'unary'; readonly op: string; readonly of: Tree }
  | { readonly kind: 'binary'; readonly op: string; readonly left: Tree; readonly right: Tree }
  | { readonly kind: 'call'; readonly name: string; readonly values: readonly Tree[] };

/** As much as the runtime takes. */
const MOST_CHARACTERS = 1000;
/** Weakest first; operators of one line are of equal rank. */
const RANKS: readonly (readonly string[])[] = [
  ['OR', 'OR_ELSE'],
  ['XOR'],
  ['AND', '&', 'AND_THEN'],
  ['=', '<>'],
  ['<', '>', '<=', '>='],
  ['+', '-'],
  ['*', '/', 'MOD'],
];
const PREFIXES: ReadonlySet<string> = new Set(['+', '-', 'NOT']);
const OPERATOR_WORDS: ReadonlySet<string> = new Set(OPERATOR_KEYWORDS);

interface Piece {
  readonly kind: TokenKind;
  readonly text: string;
}

/** Null for a mere variable or literal, and for a text that is no expression. */
export function parseTree(text: string): Tree | null {
  if (text.length > MOST_CHARACTERS) return null;
  const pieces = codeTokens(text).map((token): Piece => ({ kind: token.kind, text: textOf(text, token) }));
  const parser = new Parser(pieces);
  const tree = parser.expression();
  const lone = tree === null || tree.kind === 'variable' || tree.kind === 'literal' || tree.kind === 'text';
  return parser.atEnd && !(lone && pieces[0]?.text !== '(') ? tree : null;
}

class Parser {
  private at = 0;

  constructor(private readonly pieces: readonly Piece[]) {}

  get atEnd(): boolean {
    return this.at === this.pieces.length;
  }

  expression(rank = 0): Tree | null {
    if (rank === RANKS.length) return this.unary();
    let left = this.expression(rank + 1);
    for (let op = this.word; left && op !== null && RANKS[rank]!.includes(op); op = this.word) {
      this.at += 1;
      const right = this.expression(rank + 1);
      left = right && { kind: 'binary', op: op === '&' ? 'AND' : op, left, right };
    }
    return left;
  }

  private get word(): string | null {
    return this.pieces[this.at]?.text.toUpperCase() ?? null;
  }

  private take(text: string): boolean {
    if (this.word !== text) return false;
    this.at += 1;
    return true;
  }

  private unary(): Tree | null {
    const op = this.word;
    if (op !== null && PREFIXES.has(op)) {
      this.at += 1;
      const of = this.unary();
      return of && { kind: 'unary', op, of };
    }
    let left = this.operand();
    while (left && this.take('**')) {
      const right = PREFIXES.has(this.word ?? '') ? this.unary() : this.operand();
      left = right && { kind: 'binary', op: '**', left, right };
    }
    return left;
  }

  private operand(): Tree | null {
    const piece = this.pieces[this.at];
    if (piece === undefined) return null;
    if (this.take('(')) {
      const inner = this.expression();
      return this.take(')') ? inner : null;
    }
    const word = piece.text.toUpperCase();
    if (piece.kind === 'string' || piece.kind === 'wstring') return this.taken({ kind: 'text', text: piece.text });
    if (word === 'TRUE' || word === 'FALSE') return this.taken({ kind: 'literal', text: word });
    if (piece.kind === 'number') return this.taken(numberTree(piece.text));
    if (piece.kind === 'word' && this.pieces[this.at + 1]?.text === '(') return this.call(word);
    const path = OPERATOR_WORDS.has(word) ? null : this.path();
    return path === null ? null : { kind: 'variable', path };
  }

  private taken(tree: Tree): Tree {
    this.at += 1;
    return tree;
  }

  private call(name: string): Tree | null {
    const counts = FUNCTIONS[name];
    if (counts === undefined) return null;
    this.at += 2;
    const values: Tree[] = [];
    do {
      const value = this.expression();
      if (!value) return null;
      values.push(value);
    } while (this.take(','));
    const right = this.take(')') && values.length >= counts[0] && values.length <= counts[1];
    return right ? { kind: 'call', name, values } : null;
  }

  /** Names, members, indices and `^`, which the server resolves. */
  private path(): string | null {
    let path = this.take('.') ? '.' : '';
    const first = this.pieces[this.at];
    if (first?.kind !== 'word' && !(first?.kind === 'address' && path === '')) return null;
    path += first.text;
    this.at += 1;
    for (;;) {
      if (this.take('^')) path += '^';
      else if (this.take('.')) {
        const member = this.pieces[this.at];
        if (member?.kind !== 'word' && member?.kind !== 'number') return null;
        path += `.${member.text}`;
        this.at += 1;
      } else if (this.take('[')) {
        const index = this.index();
        if (index === null) return null;
        path += `[${index}]`;
      } else return path;
    }
  }

  private index(): string | null {
    let text = '';
    for (let piece = this.pieces[this.at]; piece !== undefined; piece = this.pieces[this.at]) {
      this.at += 1;
      if (piece.text === ']') return text === '' ? null : text;
      if (piece.text === '[') return null;
      text += piece.text === ',' ? ', ' : piece.text;
    }
    return null;
  }
}

/** `Colour#Red` is the value of an enumeration. */
function numberTree(text: string): Tree {
  const named = /^([^\d#][^#]*)#([^\d#+-].*)$/.exec(text);
  if (named === null || elementaryNamed(named[1]!) !== null) return { kind: 'literal', text };
  return { kind: 'variable', path: `${named[1]!}.${named[2]!}` };
}
