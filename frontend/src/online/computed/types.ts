/**
 * The elementary types of expressions and how two of them meet (LOPR-01 .. LOPR-03), as the compiler and the evaluator
 * of the runtime have it: integers narrower than 32 bit are computed in DINT.
 */
import { valueKind, type SubscribedItem, type ValueKind } from '../item';

export interface Elementary {
  readonly name: string;
  readonly family: 'bool' | 'bits' | 'signed' | 'unsigned' | 'real' | 'time' | 'date';
  /** Bytes. */
  readonly size: number;
}

/** A value in its type: whole numbers, bit strings, times and dates as `bigint`, BOOL as 0 and 1, reals as `number`. */
export type Scalar = bigint | number;

type Family = Elementary['family'];
const FAMILIES: readonly [Family, readonly string[]][] = [
  ['bits', ['BYTE', 'WORD', 'DWORD', 'LWORD']],
  ['signed', ['SINT', 'INT', 'DINT', 'LINT']],
  ['unsigned', ['USINT', 'UINT', 'UDINT', 'ULINT']],
];
const ALL: readonly Elementary[] = [
  { name: 'BOOL', family: 'bool', size: 1 },
  ...FAMILIES.flatMap(([family, names]) => names.map((name, power) => ({ name, family, size: 2 ** power }))),
  { name: 'REAL', family: 'real', size: 4 },
  { name: 'LREAL', family: 'real', size: 8 },
  { name: 'TIME', family: 'time', size: 4 },
  { name: 'LTIME', family: 'time', size: 8 },
  ...['DATE', 'TOD', 'DT'].map((name): Elementary => ({ name, family: 'date', size: 4 })),
  ...['LDATE', 'LTOD', 'LDT'].map((name): Elementary => ({ name, family: 'date', size: 8 })),
];
const BY_NAME: ReadonlyMap<string, Elementary> = new Map(ALL.map((type) => [type.name, type]));
const SYNONYMS: Readonly<Record<string, string>> = {
  T: 'TIME',
  LT: 'LTIME',
  D: 'DATE',
  LD: 'LDATE',
  TIME_OF_DAY: 'TOD',
  LTIME_OF_DAY: 'LTOD',
  DATE_AND_TIME: 'DT',
  LDATE_AND_TIME: 'LDT',
};

/** The type of a name or of the prefix of a literal; null for that of no elementary type. */
export function elementaryNamed(name: string): Elementary | null {
  const upper = name.toUpperCase();
  return BY_NAME.get(SYNONYMS[upper] ?? upper) ?? null;
}

const known = (name: string) => BY_NAME.get(name)!;
export const BOOL = known('BOOL');
export const REAL = known('REAL');
export const LREAL = known('LREAL');
const DINT = known('DINT');
const LINT = known('LINT');
export const ULINT = known('ULINT');

export const isInteger = (type: Elementary) => ['bits', 'signed', 'unsigned'].includes(type.family);
export const isTime = (type: Elementary) => type.family === 'time' || type.family === 'date';

function sized(family: Family, size: number): Elementary | null {
  return ALL.find((type) => type.family === family && type.size === size) ?? null;
}

const FAMILY_OF: Partial<Record<ValueKind, Family>> = { bits: 'bits', int: 'signed', uint: 'unsigned', real: 'real' };

/** What the server says about a variable. */
export type TypedItem = Pick<SubscribedItem, 'kind' | 'type' | 'size' | 'bit' | 'enum' | 'base' | 'error'>;

/** The type that holds the values of a variable; null for texts, what has parts, and what only leads to a value. */
export function elementaryOf(item: TypedItem): Elementary | null {
  const kind = valueKind(item);
  if (kind === 'bool') return BOOL;
  if (kind === 'enum') return elementaryOf({ kind: item.base || 'int', type: item.type, size: item.size });
  // What a reference refers to is not among the values that a frame carries.
  if (kind === 'pointer') return item.kind === 'pointer' ? known('LWORD') : null;
  const family = FAMILY_OF[kind];
  return family === undefined ? elementaryNamed(kind) : sized(family, item.size);
}

/** An item that says how values of a type are shown. */
export function itemOf(type: Elementary): Pick<SubscribedItem, 'kind' | 'type' | 'size'> {
  const kinds: Partial<Record<Family, string>> = { signed: 'int', unsigned: 'uint' };
  return { kind: kinds[type.family] ?? type.family, type: type.name, size: type.size };
}

/** A whole number as a type holds it: what is beyond it is cut off. */
export function hold(value: bigint, type: Elementary): bigint {
  if (type.family === 'bool') return value;
  return type.family === 'signed' ? BigInt.asIntN(8 * type.size, value) : BigInt.asUintN(8 * type.size, value);
}

export const holds = (type: Elementary, value: bigint) =>
  type.family === 'bool' ? value === 0n || value === 1n : hold(value, type) === value;

/** The smallest type of a whole number (LTYP-31); null beyond 64 bit. */
export function smallestInteger(value: bigint): Elementary | null {
  for (const size of [1, 2, 4, 8]) {
    const found = [sized('signed', size)!, sized('unsigned', size)!].find((type) => holds(type, value));
    if (found) return found;
  }
  return null;
}

/** A real number as a type holds it. */
export const rounded = (value: number, type: Elementary) => (type === REAL ? Math.fround(value) : value);

/** A whole number in a real type, rounded once (half to even). */
export function realOf(value: bigint, type: Elementary): number {
  if (type !== REAL) return Number(value);
  const size = value < 0n ? -value : value;
  if (size < 2n ** 53n) return Math.fround(Number(value));
  // By way of LREAL it would be rounded twice: what is cut off only leaves an odd last bit.
  const shift = BigInt(size.toString(2).length - 50);
  const top = size >> shift;
  const sticky = top << shift === size ? top : top | 1n;
  return Math.fround(Number(sticky)) * 2 ** Number(shift) * (value < 0n ? -1 : 1);
}

export interface Meeting {
  /** Static type of the result, by which it meets the next operand. */
  readonly type: Elementary;
  /** Type in which both are computed. */
  readonly computed: Elementary;
}

/** How two numbers meet in an operation; null where one of them is no number. */
export function meet(left: Elementary, right: Elementary): Meeting | null {
  const number = (type: Elementary) => isInteger(type) || type.family === 'real';
  if (!number(left) || !number(right)) return null;
  if (left.family === 'real' || right.family === 'real') {
    const both = left.family === right.family;
    const type = left.family !== 'real' || (both && right.size > left.size) ? right : left;
    return { type, computed: type };
  }
  const type = larger(left, right, 'signed', 'unsigned');
  if (type.size < 4) return { type, computed: DINT };
  const signed = [left, right].filter((one) => one.family === 'signed').length;
  if (signed === 2) return { type, computed: type.size === 4 ? DINT : LINT };
  if (signed === 0) return { type, computed: type };
  const unsigned = left.family === 'signed' ? right : left;
  if (unsigned.size === 8) return { type, computed: type };
  return { type, computed: unsigned.size === 4 || type.size === 8 ? LINT : DINT };
}

/** The type of AND, OR and XOR: the wider one, of equal width the bit string; null where they are not possible. */
export function meetBits(left: Elementary, right: Elementary): Elementary | null {
  if (left === BOOL && right === BOOL) return BOOL;
  return isInteger(left) && isInteger(right) ? larger(left, right, 'bits') : null;
}

/** The wider type, of equal width one of the preferred families, else the left one. */
function larger(left: Elementary, right: Elementary, ...preferred: readonly Family[]): Elementary {
  if (left.size !== right.size) return left.size > right.size ? left : right;
  for (const family of preferred) {
    if (left.family === family) return left;
    if (right.family === family) return right;
  }
  return left;
}

/** In which a minus in front is computed. */
export function signedOf(type: Elementary): Elementary {
  if (!isInteger(type) || type.size === 8) return type;
  if (type.size < 4) return DINT;
  return type.family === 'signed' ? type : LINT;
}
