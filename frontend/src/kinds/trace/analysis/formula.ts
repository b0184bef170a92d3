/**
 * Formula channels: an IEC expression over other channels, computed sample by sample in LREAL.
 *
 * The twin of the server's `traces/formula.py`: the same words, values and faults, by one table of cases
 * (tests/traces/data). TRUE is 1 and FALSE is 0; a gap of any channel is a gap of the result. Precedence is that of
 * IEC 61131-3, table 71; the values are those of IEEE 754.
 */

export type FormulaFault = 'empty' | 'unexpected' | 'end' | 'function' | 'arguments' | 'tooDeep';

export class FormulaError extends Error {
  constructor(
    readonly fault: FormulaFault,
    /** Place in the text, from 0. */
    readonly at: number,
    readonly word: string,
  ) {
    super(`${fault} at ${at}: ${word}`);
  }
}

export interface Formula {
  /** The channels it is over, each once, as they are first spelt. */
  channels: readonly string[];
  /** Its value for values of `channels` in that order. */
  value: (channels: ArrayLike<number>) => number;
}

type Node = (channels: ArrayLike<number>) => number;
type Call = { least: number; most: number; of: (...values: number[]) => number };

/** As IEEE 754 has it: ECMAScript alone has no value for 1 ** NaN, 1 ** Infinity and (-1) ** Infinity. */
const power = (base: number, exponent: number) =>
  base === 1 || (base === -1 && Math.abs(exponent) === Infinity) ? 1 : base ** exponent;
const truth = (value: boolean) => (value ? 1 : 0);
const one = (of: (value: number) => number): Call => ({ least: 1, most: 1, of });
/** Names as IEC 61131-3 has them; SQR and LIMIT with its order MN, IN, MX. */
export const FUNCTIONS: Readonly<Record<string, Call>> = {
  ABS: one(Math.abs),
  SQRT: one(Math.sqrt),
  LN: one(Math.log),
  LOG: one(Math.log10),
  EXP: one(Math.exp),
  SIN: one(Math.sin),
  COS: one(Math.cos),
  TAN: one(Math.tan),
  ASIN: one(Math.asin),
  ACOS: one(Math.acos),
  ATAN: one(Math.atan),
  TRUNC: one(Math.trunc),
  FLOOR: one(Math.floor),
  CEIL: one(Math.ceil),
  SGN: one(Math.sign),
  ATAN2: { least: 2, most: 2, of: Math.atan2 },
  EXPT: { least: 2, most: 2, of: power },
  MIN: { least: 2, most: 64, of: Math.min },
  MAX: { least: 2, most: 64, of: Math.max },
  LIMIT: { least: 3, most: 3, of: (low, value, high) => Math.min(Math.max(value, low), high) },
  SEL: { least: 3, most: 3, of: (choice, zero, other) => (choice ? other : zero) },
};

const CONSTANTS: Readonly<Record<string, number>> = { TRUE: 1, FALSE: 0, PI: Math.PI };

/** Operators from loose to tight. */
const LEVELS: readonly Readonly<Record<string, (a: number, b: number) => number>>[] = [
  { OR: (a, b) => truth(a !== 0 || b !== 0) },
  { XOR: (a, b) => truth((a !== 0) !== (b !== 0)) },
  { AND: (a, b) => truth(a !== 0 && b !== 0), '&': (a, b) => truth(a !== 0 && b !== 0) },
  { '=': (a, b) => truth(a === b), '<>': (a, b) => truth(a !== b) },
  {
    '<': (a, b) => truth(a < b),
    '>': (a, b) => truth(a > b),
    '<=': (a, b) => truth(a <= b),
    '>=': (a, b) => truth(a >= b),
  },
  { '+': (a, b) => a + b, '-': (a, b) => a - b },
  { '*': (a, b) => a * b, '/': (a, b) => a / b, MOD: (a, b) => a % b },
  { '**': power },
];
const WORDS = new Set(['OR', 'XOR', 'AND', 'MOD', 'NOT']);
const MOST_DEPTH = 50;

interface Token {
  /** `other`: a character that no token begins with. */
  kind: 'number' | 'name' | 'sign' | 'end' | 'other';
  text: string;
  at: number;
}

const NUMBER = /(?:16#[0-9A-Fa-f][0-9A-Fa-f_]*|8#[0-7][0-7_]*|2#[01][01_]*|\d[\d_]*(?:\.\d[\d_]*)?(?:[eE][+-]?\d+)?)/y;
const SPACE = String.raw`[ \t\n\r\f\v]*`;
/** Letters of any script: names of channels are free. */
const WORD = String.raw`[\p{L}\p{N}_]`;
const NAME = new RegExp(
  String.raw`[\p{L}\p{Nl}\p{No}_]${WORD}*` +
    String.raw`(?:\^?(?:${SPACE}\.${SPACE}${WORD}+|${SPACE}\[[^\]\[]*(?:\[[^\]]*\][^\]\[]*)*\]))*\^?`,
  'uy',
);
const SIGN = /\*\*|<=|>=|<>|[-+*/()<>=,&]/y;

function tokens(text: string): Token[] {
  const found: Token[] = [];
  let at = 0;
  while (at < text.length) {
    if (' \t\n\r\f\v'.includes(text[at]!)) {
      at += 1;
      continue;
    }
    const kinds = [
      ['number', NUMBER],
      ['name', NAME],
      ['sign', SIGN],
    ] as const;
    const hit = kinds.map(([kind, pattern]) => {
      pattern.lastIndex = at;
      return { kind, text: pattern.exec(text)?.[0] };
    });
    const token = hit.find((each) => each.text !== undefined);
    const word = token?.text ?? String.fromCodePoint(text.codePointAt(at)!);
    found.push({ kind: token?.kind ?? 'other', text: word, at });
    at += word.length;
  }
  return [...found, { kind: 'end', text: '', at: text.length }];
}

const withoutSpaces = (name: string) => name.replace(/[ \t\n\r\f\v]+/g, '');
/** As expressions are compared: without spaces, in capitals. */
export const channelKey = (name: string) => withoutSpaces(name).toUpperCase();

/** Reads a formula; throws `FormulaError` with the place of what is wrong. */
export function parseFormula(text: string): Formula {
  const words = tokens(text);
  const channels: string[] = [];
  let position = 0;
  let depth = 0;

  const peek = () => words[position]!;
  const upper = () => (peek().kind === 'number' ? '' : peek().text.toUpperCase());
  const unexpected = (): never => {
    const { kind, at, text: word } = peek();
    throw new FormulaError(kind === 'end' ? 'end' : 'unexpected', at, word);
  };
  const expect = (sign: string) => {
    if (peek().kind !== 'sign' || peek().text !== sign) unexpected();
    position += 1;
  };

  const level = (number: number): Node => {
    const operators = LEVELS[number];
    if (operators === undefined) return prefix();
    let left = level(number + 1);
    for (let operator = operators[upper()]; operator !== undefined; operator = operators[upper()]) {
      position += 1;
      const [a, b, act] = [left, level(number + 1), operator];
      left = (values) => act(a(values), b(values));
    }
    return left;
  };
  const prefix = (): Node => {
    const sign = upper();
    if (sign !== '-' && sign !== '+' && sign !== 'NOT') return atom();
    position += 1;
    const of = deeper(prefix);
    if (sign === '+') return of;
    return sign === '-' ? (values) => -of(values) : (values) => truth(of(values) === 0);
  };
  const atom = (): Node => {
    const token = peek();
    if (token.kind === 'number') {
      position += 1;
      const value = numberOf(token.text);
      return () => value;
    }
    if (token.kind === 'sign' && token.text === '(') {
      position += 1;
      const inner = deeper(() => level(0));
      expect(')');
      return inner;
    }
    if (token.kind !== 'name' || WORDS.has(token.text.toUpperCase())) return unexpected();
    position += 1;
    if (peek().kind === 'sign' && peek().text === '(') return call(token);
    const constant = CONSTANTS[token.text.toUpperCase()];
    if (constant !== undefined) return () => constant;
    const key = channelKey(token.text);
    let index = channels.findIndex((each) => channelKey(each) === key);
    if (index < 0) index = channels.push(withoutSpaces(token.text)) - 1;
    return (values) => values[index]!;
  };
  const call = (name: Token): Node => {
    const known = FUNCTIONS[name.text.toUpperCase()];
    if (known === undefined) throw new FormulaError('function', name.at, name.text);
    const given: Node[] = [];
    do {
      position += 1;
      given.push(deeper(() => level(0)));
    } while (peek().kind === 'sign' && peek().text === ',');
    expect(')');
    if (given.length < known.least || given.length > known.most)
      throw new FormulaError('arguments', name.at, name.text);
    return (values) => known.of(...given.map((each) => each(values)));
  };
  const deeper = (read: () => Node): Node => {
    if (depth >= MOST_DEPTH) throw new FormulaError('tooDeep', peek().at, peek().text);
    depth += 1;
    const node = read();
    depth -= 1;
    return node;
  };

  if (peek().kind === 'end') throw new FormulaError('empty', 0, '');
  const root = level(0);
  if (peek().kind !== 'end') unexpected();
  return {
    channels,
    value: (values) => {
      for (let k = 0; k < channels.length; k += 1) if (Number.isNaN(values[k])) return NaN;
      return root(values);
    },
  };
}

function numberOf(text: string): number {
  const plain = text.replace(/_/g, '');
  const [base, digits] = plain.split('#');
  return digits === undefined ? Number(plain) : parseInt(digits, Number(base));
}

/** The formula for each sample of its channels, which have the same times. */
export function computed(formula: Formula, channels: readonly ArrayLike<number>[], count: number): Float64Array {
  const row = new Float64Array(channels.length);
  return Float64Array.from({ length: count }, (_, at) => {
    for (let k = 0; k < row.length; k += 1) row[k] = channels[k]![at]!;
    return formula.value(row);
  });
}
