/**
 * Expressions of watch lists: arithmetic, comparisons and logic over variables. The variables of an expression come with
 * one frame, so that its value is of one cycle. Whole numbers are computed without a limit of size. Pure functions.
 */
import { valueKind, type PlcValue, type SubscribedItem } from './item';

/** BOOL, whole number, real number. */
export type Operand = boolean | bigint | number;

export interface Computed {
  /** The variables in it, each once. */
  readonly operands: readonly string[];
  /** Null where a variable has no value, or there is no result: a whole number divided by zero, a sum of BOOL. */
  readonly evaluate: (valueOf: (expression: string) => Operand | null) => Operand | null;
}

type Node = (valueOf: (expression: string) => Operand | null) => Operand | null;

const TOKEN =
  /\s*(?:(\d+#[0-9A-Fa-f_]+)|(\d[\d_]*\.\d[\d_]*(?:[eE][+-]?\d+)?|\d[\d_]*[eE][+-]?\d+)|(\d[\d_]*)|(%?[A-Za-z_][\w%]*(?:\.\w+|\[[^\][]*\]|\^)*)|(\*\*|<>|<=|>=|[-+*/()<>=&,]))/y;
const FUNCTIONS: Readonly<Record<string, (values: readonly Operand[]) => Operand | null>> = {
  ABS: ([a]) => (typeof a === 'bigint' ? (a < 0n ? -a : a) : typeof a === 'number' ? Math.abs(a) : null),
  SQRT: ([a]) => (a === undefined || typeof a === 'boolean' ? null : Math.sqrt(Number(a))),
  MIN: (values) => extreme(values, (a, b) => a < b),
  MAX: (values) => extreme(values, (a, b) => a > b),
  LIMIT: ([low, a, high]) => extreme([extreme([low!, a!], (x, y) => x > y) ?? false, high!], (x, y) => x < y),
};
const ARGUMENTS: Readonly<Record<string, readonly [number, number]>> = {
  ABS: [1, 1],
  SQRT: [1, 1],
  MIN: [2, 32],
  MAX: [2, 32],
  LIMIT: [3, 3],
};
/** Weakest first; operators of one line are of equal rank. */
const RANKS: readonly (readonly string[])[] = [
  ['OR'],
  ['XOR'],
  ['AND', '&'],
  ['=', '<>'],
  ['<', '>', '<=', '>='],
  ['+', '-'],
  ['*', '/', 'MOD'],
];
const WORDS = new Set(['AND', 'OR', 'XOR', 'NOT', 'MOD', 'TRUE', 'FALSE']);

/** What an expression computes; null for a mere variable, and for a text that is no expression. */
export function parseComputed(text: string): Computed | null {
  const tokens = tokenized(text);
  if (tokens === null || tokens.length < 2) return null;
  const operands: string[] = [];
  let at = 0;
  const peek = () => tokens[at]?.toUpperCase();
  const take = (word: string) => peek() === word && ((at += 1), true);

  const ranked = (rank: number): Node | null => {
    if (rank === RANKS.length) return unary();
    let left = ranked(rank + 1);
    for (let operator = peek(); left && operator !== undefined && RANKS[rank]!.includes(operator); operator = peek()) {
      at += 1;
      const right = ranked(rank + 1);
      if (!right) return null;
      left = binary(operator, left, right);
    }
    return left;
  };
  const unary = (): Node | null => {
    const sign = peek();
    if (sign !== '-' && sign !== 'NOT') return power();
    at += 1;
    const inner = unary();
    return inner && ((valueOf) => applied(inner(valueOf), sign === '-' ? negated : inverted));
  };
  const power = (): Node | null => {
    const base = primary();
    if (!base || !take('**')) return base;
    const exponent = unary();
    return exponent && binary('**', base, exponent);
  };
  const primary = (): Node | null => {
    const token = tokens[at];
    if (token === undefined) return null;
    at += 1;
    const word = token.toUpperCase();
    if (token === '(') {
      const inner = ranked(0);
      return inner && take(')') ? inner : null;
    }
    if (/^\d/.test(token)) return constant(literal(token));
    if (word === 'TRUE' || word === 'FALSE') return constant(word === 'TRUE');
    if (!/^[%A-Za-z_]/.test(token) || WORDS.has(word)) return null;
    const known = FUNCTIONS[word];
    if (known && take('(')) {
      const values: Node[] = [];
      do {
        const value = ranked(0);
        if (!value) return null;
        values.push(value);
      } while (take(','));
      const [least, most] = ARGUMENTS[word]!;
      if (!take(')') || values.length < least || values.length > most) return null;
      return (valueOf) => {
        const given = values.map((value) => value(valueOf));
        return given.some((value) => value === null) ? null : known(given as Operand[]);
      };
    }
    if (!operands.includes(token)) operands.push(token);
    return (valueOf) => valueOf(token);
  };

  const root = ranked(0);
  if (!root || at < tokens.length) return null;
  return { operands, evaluate: root };
}

function tokenized(text: string): string[] | null {
  const found: string[] = [];
  TOKEN.lastIndex = 0;
  const end = text.trimEnd().length;
  while (TOKEN.lastIndex < end) {
    const match = TOKEN.exec(text);
    if (match === null) return null;
    found.push(match[0].trim());
  }
  return found;
}

const constant =
  (value: Operand | null): Node =>
  () =>
    value;

function literal(token: string): Operand | null {
  const plain = token.replaceAll('_', '');
  const [base, digits] = plain.split('#');
  if (digits === undefined) return /^\d+$/.test(plain) ? BigInt(plain) : Number(plain);
  const prefix = { '2': '0b', '8': '0o', '16': '0x' }[base!];
  try {
    return prefix === undefined ? null : BigInt(prefix + digits);
  } catch {
    return null;
  }
}

function binary(operator: string, left: Node, right: Node): Node {
  return (valueOf) => {
    const a = left(valueOf);
    const b = right(valueOf);
    return a === null || b === null ? null : joined(operator, a, b);
  };
}

function joined(operator: string, a: Operand, b: Operand): Operand | null {
  if (typeof a === 'boolean' || typeof b === 'boolean') {
    if (typeof a !== typeof b) return null;
    return logic(operator, a as boolean, b as boolean);
  }
  const order = compared(operator, a, b);
  if (order !== null) return order;
  return typeof a === 'bigint' && typeof b === 'bigint' ? whole(operator, a, b) : real(operator, Number(a), Number(b));
}

function logic(operator: string, a: boolean, b: boolean): boolean | null {
  switch (operator) {
    case 'AND':
    case '&':
      return a && b;
    case 'OR':
      return a || b;
    case 'XOR':
    case '<>':
      return a !== b;
    case '=':
      return a === b;
    default:
      return null;
  }
}

function compared(operator: string, a: bigint | number, b: bigint | number): boolean | null {
  switch (operator) {
    case '=':
      return !(a < b) && !(a > b) && !Number.isNaN(Number(a)) && !Number.isNaN(Number(b));
    case '<>':
      return a < b || a > b || Number.isNaN(Number(a)) || Number.isNaN(Number(b));
    case '<':
      return a < b;
    case '>':
      return a > b;
    case '<=':
      return a <= b;
    case '>=':
      return a >= b;
    default:
      return null;
  }
}

function whole(operator: string, a: bigint, b: bigint): Operand | null {
  switch (operator) {
    case '+':
      return a + b;
    case '-':
      return a - b;
    case '*':
      return a * b;
    case '/':
      return b === 0n ? null : a / b;
    case 'MOD':
      return b === 0n ? null : a % b;
    case 'AND':
    case '&':
      return a & b;
    case 'OR':
      return a | b;
    case 'XOR':
      return a ^ b;
    case '**':
      return finite(Number(a) ** Number(b));
    default:
      return null;
  }
}

function real(operator: string, a: number, b: number): number | null {
  switch (operator) {
    case '+':
      return a + b;
    case '-':
      return a - b;
    case '*':
      return a * b;
    case '/':
      return a / b; // IEEE 754, as in the controller
    case '**':
      return finite(a ** b);
    default:
      return null;
  }
}

const applied = (value: Operand | null, act: (value: Operand) => Operand | null) =>
  value === null ? null : act(value);
const negated = (value: Operand) => (typeof value === 'boolean' ? null : -value);
const inverted = (value: Operand) => (typeof value === 'boolean' ? !value : typeof value === 'bigint' ? ~value : null);
const finite = (value: number) => (Number.isFinite(value) ? value : null);

function extreme(values: readonly Operand[], better: (a: Operand, b: Operand) => boolean): Operand | null {
  if (values.some((value) => typeof value === 'boolean')) return null;
  const same = values.some((value) => typeof value === 'number') ? values.map(Number) : values;
  return same.reduce((best, value) => (better(value, best) ? value : best));
}

/** A live value as operand: what is neither BOOL nor number (texts, structures) is none. */
export function operandOf(
  value: PlcValue | null,
  item: Pick<SubscribedItem, 'kind' | 'type' | 'size' | 'bit'>,
): Operand | null {
  if (value === null || typeof value === 'string') return null;
  if (typeof value === 'boolean') return value;
  if (valueKind(item) === 'real') return Number(value);
  return BigInt(value);
}

/** The result with an item that says how it is shown. */
export function resultItem(value: Operand): Pick<SubscribedItem, 'kind' | 'type' | 'size'> {
  if (typeof value === 'boolean') return { kind: 'bool', type: 'BOOL', size: 1 };
  return typeof value === 'bigint' ? { kind: 'int', type: 'LINT', size: 8 } : { kind: 'real', type: 'LREAL', size: 8 };
}
