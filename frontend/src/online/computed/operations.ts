/**
 * The operations of expressions on typed operands, as the evaluator of the runtime has them. An operand is checked when
 * it is made; its value is computed when it is asked for, so that the right side of AND_THEN may have none.
 */
import type { TextKey, TextValues } from '@/i18n';
import {
  BOOL,
  hold,
  holds,
  isInteger,
  isTime,
  LREAL,
  meet,
  meetBits,
  realOf,
  rounded,
  signedOf,
  smallestInteger,
  ULINT,
  type Elementary,
  type Scalar,
} from './types';

/** Why an expression has no value. */
export class ComputedError extends Error {
  constructor(
    readonly key: TextKey,
    readonly values: TextValues = {},
  ) {
    super(key);
  }
}

export interface Operand {
  /** Static type, by which it meets another operand. */
  readonly type: Elementary;
  /** In which its value is held: the result of an operation is held in the type that it was computed in. */
  readonly held: Elementary;
  /** Of a number without a type, which adapts to the other operand. */
  readonly literal?: Scalar;
  /** The type as declared. */
  readonly declared?: string;
  /** Of an enumeration. */
  readonly enumerators?: Readonly<Record<string, number>>;
  readonly value: () => Scalar;
}

const nameOf = (operand: Operand) => operand.declared ?? operand.type.name;
const computedIn = (type: Elementary, held: Elementary, value: () => Scalar): Operand => ({ type, held, value });
const truth = (value: () => boolean) => computedIn(BOOL, BOOL, () => (value() ? 1n : 0n));

/** A number without a type. */
export function untyped(literal: Scalar): Operand {
  const type = typeof literal === 'number' ? LREAL : smallestInteger(literal);
  if (type === null) throw new ComputedError('watch.computed.large', { value: String(literal) });
  return { ...constant(literal, type), literal };
}

/** A number of a type. */
export function constant(given: Scalar, type: Elementary): Operand {
  if (type.family === 'real') {
    const value = rounded(Number(given), type);
    return computedIn(type, type, () => value);
  }
  if (typeof given === 'number' || !holds(type, given))
    throw new ComputedError('watch.computed.outside', { value: String(given), type: type.name });
  return computedIn(type, type, () => given);
}

/** The same value in a type that an operation computes in. */
function converted(operand: Operand, type: Elementary): Operand {
  if (operand.literal !== undefined) return constant(operand.literal, type);
  const { value } = operand;
  if (type.family !== 'real') return computedIn(type, type, () => hold(value() as bigint, type));
  if (operand.held.family === 'real') return computedIn(type, type, value);
  return computedIn(type, type, () => realOf(value() as bigint, type));
}

/** A literal takes the type of the other side, if that holds its value. */
function adapted(left: Operand, right: Operand): [Operand, Operand] {
  if ((left.literal === undefined) === (right.literal === undefined)) return [left, right];
  return left.literal === undefined ? [left, retyped(right, left.type)] : [retyped(left, right.type), right];
}

function retyped(operand: Operand, type: Elementary): Operand {
  const value = operand.literal!;
  const fits = type.family === 'real' || (typeof value === 'bigint' && isInteger(type) && holds(type, value));
  return fits ? constant(value, type) : operand;
}

function met(op: string, left: Operand, right: Operand) {
  const [a, b] = adapted(left, right);
  const meeting = meet(a.type, b.type);
  if (meeting === null) throw impossible(op, a, b);
  return { a: converted(a, meeting.computed).value, b: converted(b, meeting.computed).value, ...meeting };
}

const impossible = (op: string, left: Operand, right: Operand) =>
  new ComputedError('watch.computed.impossible', { op, left: nameOf(left), right: nameOf(right) });

const ARITHMETIC: ReadonlySet<string> = new Set(['+', '-', '*', '/', 'MOD', 'MIN', 'MAX']);
const COMPARISONS: Readonly<Record<string, (a: Scalar, b: Scalar) => boolean>> = {
  '=': (a, b) => a === b,
  '<>': (a, b) => a !== b,
  '<': (a, b) => a < b,
  '<=': (a, b) => a <= b,
  '>': (a, b) => a > b,
  '>=': (a, b) => a >= b,
};

/** Any operator between two operands. */
export function binary(op: string, left: Operand, right: Operand): Operand {
  if (op in COMPARISONS) return compare(op, left, right);
  if (op === 'AND' || op === 'OR' || op === 'XOR') return logic(op, left, right);
  if (op === 'AND_THEN' || op === 'OR_ELSE') return shortCircuit(op, left, right);
  if (!ARITHMETIC.has(op)) throw new ComputedError('watch.computed.operator', { op });
  return combine(op, left, right);
}

function combine(op: string, left: Operand, right: Operand): Operand {
  if (isTime(left.type) || isTime(right.type)) return combineTimes(op, left, right);
  if (left.literal !== undefined && right.literal !== undefined)
    return untyped(folded(op, left.literal, right.literal));
  const { a, b, type, computed } = met(op, left, right);
  if (computed.family !== 'real') return computedIn(type, computed, () => hold(whole(op, a(), b()), computed));
  if (op === 'MOD') throw new ComputedError('watch.computed.modulo');
  return computedIn(type, computed, () => rounded(real(op, a() as number, b() as number), computed));
}

/** Two literals give a literal again, of any size, which adapts to what it meets. */
function folded(op: string, a: Scalar, b: Scalar): Scalar {
  if (op === 'MIN' || op === 'MAX') return extreme(op, a, b);
  if (op === '/' || op === 'MOD') {
    if (Number(b) === 0) throw new ComputedError('watch.computed.divided', { op });
    if (op === 'MOD' && !(typeof a === 'bigint' && typeof b === 'bigint'))
      throw new ComputedError('watch.computed.modulo');
  }
  return typeof a === 'bigint' && typeof b === 'bigint' ? whole(op, a, b) : real(op, Number(a), Number(b));
}

const WHOLE: Readonly<Record<string, (a: bigint, b: bigint) => bigint>> = {
  '+': (a, b) => a + b,
  '-': (a, b) => a - b,
  '*': (a, b) => a * b,
  '/': (a, b) => a / b,
  MOD: (a, b) => a % b,
};

/** IEEE 754: a division by zero is infinite, or no number. */
const REALS: Readonly<Record<string, (a: number, b: number) => number>> = {
  '+': (a, b) => a + b,
  '-': (a, b) => a - b,
  '*': (a, b) => a * b,
  '/': (a, b) => a / b,
};

function whole(op: string, first: Scalar, second: Scalar): bigint {
  const [a, b] = [first as bigint, second as bigint];
  if ((op === '/' || op === 'MOD') && b === 0n) throw new ComputedError('watch.computed.divided', { op });
  return WHOLE[op]?.(a, b) ?? extreme(op, a, b);
}

const real = (op: string, a: number, b: number) => REALS[op]?.(a, b) ?? extreme(op, a, b);

/** MIN or MAX: the first one, unless the second is beyond it. */
function extreme<T extends Scalar>(op: string, a: T, b: T): T {
  return (op === 'MIN' ? b < a : b > a) ? b : a;
}

/** Times of one type added and subtracted, or multiplied with an integer and divided by an unsigned one. */
function combineTimes(op: string, left: Operand, right: Operand): Operand {
  const same = left.type === right.type;
  const time = left.type.family === 'time';
  const of = (a: Operand, b: Operand) =>
    computedIn(a.type, a.type, () => hold(whole(op, a.value(), b.value()), a.type));
  if (same && (op === 'MIN' || op === 'MAX' || (time && (op === '+' || op === '-')))) return of(left, right);
  if (op === '*' && right.type.family === 'time' && isInteger(left.type)) return of(right, left);
  if (op === '*' && time && isInteger(right.type)) return of(left, right);
  if (op !== '/' || !time || !isInteger(right.type)) throw impossible(op, left, right);
  const divisor = typeof right.literal === 'bigint' && right.literal >= 0n ? constant(right.literal, ULINT) : right;
  if (divisor.type.family === 'signed') throw new ComputedError('watch.computed.timeDivisor', { type: nameOf(left) });
  return of(left, converted(divisor, divisor.type));
}

function compare(op: string, left: Operand, right: Operand): Operand {
  const order = COMPARISONS[op]!;
  if (left.type === right.type && (isTime(left.type) || left.type === BOOL)) {
    if (left.type === BOOL && op !== '=' && op !== '<>') throw new ComputedError('watch.computed.order', { op });
    return truth(() => order(left.value(), right.value()));
  }
  const { a, b } = met(op, left, right);
  return truth(() => order(a(), b()));
}

function logic(op: string, left: Operand, right: Operand): Operand {
  const [a, b] = boolLiterals(...adapted(left, right));
  const type = meetBits(a.type, b.type);
  if (type === null) throw impossible(op, a, b);
  const [x, y] = type === BOOL ? [a, b] : [converted(a, type), converted(b, type)];
  return computedIn(type, type, () => {
    const [one, other] = [x.value() as bigint, y.value() as bigint];
    return hold(op === 'AND' ? one & other : op === 'OR' ? one | other : one ^ other, type);
  });
}

/** 0 and 1 beside a BOOL are FALSE and TRUE. */
function boolLiterals(left: Operand, right: Operand): [Operand, Operand] {
  const bool = (operand: Operand, other: Operand) =>
    other.type === BOOL && (operand.literal === 0n || operand.literal === 1n)
      ? constant(operand.literal, BOOL)
      : operand;
  return [bool(left, right), bool(right, left)];
}

function shortCircuit(op: string, left: Operand, right: Operand): Operand {
  if (left.type !== BOOL || right.type !== BOOL) throw impossible(op, left, right);
  return truth(() => {
    const first = left.value() !== 0n;
    return op === 'AND_THEN' ? first && right.value() !== 0n : first || right.value() !== 0n;
  });
}

/** NOT, a plus or a minus in front. */
export function unary(op: string, operand: Operand): Operand {
  if (op === '+') return operand;
  const { type } = operand;
  if (op === 'NOT') {
    if (type === BOOL) return truth(() => operand.value() === 0n);
    if (!isInteger(type)) throw new ComputedError('watch.computed.not', { type: nameOf(operand) });
    const { value } = converted(operand, type);
    return computedIn(type, type, () => hold(~(value() as bigint), type));
  }
  if (operand.literal !== undefined) return untyped(-operand.literal);
  needsNumber(op, operand);
  const computed = signedOf(type);
  const { value } = converted(operand, computed);
  return computedIn(type, computed, () => {
    const given = value();
    return typeof given === 'number' ? -given : hold(-given, computed);
  });
}

function needsNumber(op: string, operand: Operand): void {
  if (!isInteger(operand.type) && operand.type.family !== 'real')
    throw new ComputedError('watch.computed.number', { op, type: nameOf(operand) });
}

/** How many values a function takes. */
export const FUNCTIONS: Readonly<Record<string, readonly [number, number]>> = {
  ABS: [1, 1],
  SQRT: [1, 1],
  MIN: [2, Infinity],
  MAX: [2, Infinity],
  LIMIT: [3, 3],
};

export function call(name: string, values: readonly Operand[]): Operand {
  const first = values[0]!;
  if (name === 'LIMIT') return combine('MIN', combine('MAX', values[1]!, first), values[2]!); // IEC 61131-3, table 36
  if (name !== 'ABS' && name !== 'SQRT') return values.reduce((one, other) => combine(name, one, other));
  needsNumber(name, first);
  if (name === 'SQRT') {
    const type = first.type.family === 'real' ? first.type : LREAL;
    const { value } = converted(first, type);
    return computedIn(type, type, () => rounded(Math.sqrt(value() as number), type));
  }
  if (first.literal !== undefined) return untyped(first.literal < 0 ? -first.literal : first.literal);
  const { value } = converted(first, first.type);
  return computedIn(first.type, first.type, () => {
    const given = value();
    return typeof given === 'number' ? Math.abs(given) : hold(given < 0n ? -given : given, first.type);
  });
}
