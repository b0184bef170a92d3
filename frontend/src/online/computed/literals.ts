/** The values of IEC 61131-3 literals, exact, as the compiler reads them (LTYP-30 .. LTYP-40). */
import { exactDuration } from '@/iec/duration';
import { elementaryNamed, holds, LREAL, REAL, rounded, type Elementary, type Scalar } from './types';

export interface Literal {
  /** Null for a number without a type. */
  readonly type: Elementary | null;
  readonly value: Scalar;
}

const LARGEST = 2n ** 64n - 1n;
const WHOLE = /^\d+(?:_\d+)*$/;
const BASED = /^(2|8|10|16)#([0-9A-F]+(?:_[0-9A-F]+)*)$/i;
const REAL_NUMBER = /^\d+(?:_\d+)*(?:\.\d+(?:_\d+)*)?(?:E[+-]?\d+)?$/i;
const DIGITS: Readonly<Record<string, [RegExp, string]>> = {
  '2': [/^[01]+$/, '0b'],
  '8': [/^[0-7]+$/, '0o'],
  '10': [/^\d+$/, ''],
  '16': [/^/, '0x'],
};

/** `INT#5`, `16#FF`, `1.5`, `T#1s500ms`, `TRUE`; null where no type holds it, or it is none. */
export function literalOf(given: string): Literal | null {
  const text = given.replace(/(?<=[0-9A-Z])_{2,}(?=[0-9A-Z])/gi, '_');
  const hash = text.indexOf('#');
  if (/^(?:TRUE|FALSE)$/i.test(text)) return typedNumber('BOOL', text);
  if (hash < 0 || /^\d/.test(text)) {
    const value = number(text);
    return value === null ? null : { type: null, value };
  }
  const type = elementaryNamed(text.slice(0, hash));
  const body = text.slice(hash + 1);
  if (type === null) return null;
  if (type.family !== 'time' && type.family !== 'date') return typedNumber(type.name, body);
  const value = type.family === 'time' ? duration(body, type) : moment(body, type);
  return value !== null && holds(type, value) ? { type, value } : null;
}

function number(text: string): Scalar | null {
  const plain = text.replaceAll('_', '');
  if (WHOLE.test(text)) return within(BigInt(plain));
  const based = BASED.exec(text);
  if (based) {
    const [digits, prefix] = DIGITS[based[1]!]!;
    const body = based[2]!.replaceAll('_', '');
    return digits.test(body) ? within(BigInt(prefix + body)) : null;
  }
  const value = REAL_NUMBER.test(text) ? Number(plain) : Infinity;
  return Number.isFinite(value) ? value : null;
}

const within = (value: bigint) => (value <= LARGEST ? value : null);

function typedNumber(name: string, body: string): Literal | null {
  const type = elementaryNamed(name)!;
  if (type.family === 'bool') {
    const value = { TRUE: 1n, '1': 1n, FALSE: 0n, '0': 0n }[body.toUpperCase()];
    return value === undefined ? null : { type, value };
  }
  const unsigned = number(body.replace(/^[+-]/, ''));
  if (unsigned === null) return null;
  const value = body.startsWith('-') ? -unsigned : unsigned;
  if (type === REAL || type === LREAL) {
    const found = rounded(Number(value), type);
    return Number.isFinite(found) ? { type, value: found } : null;
  }
  return typeof value === 'bigint' && holds(type, value) ? { type, value } : null;
}

/** TIME in ms, LTIME in ns. */
function duration(text: string, type: Elementary): bigint | null {
  const long = type.size === 8;
  const found = exactDuration(text.replace(/^\++/, ''));
  if (found === null || (!long && /^[un]s$/.test(found.unit))) return null;
  const step = found.scale * (long ? 1n : 1_000_000n);
  return found.total % step === 0n ? found.total / step : null;
}

const DAY = 86_400n;

/** DATE and DT in s, TOD in ms, the long ones in ns. */
function moment(body: string, type: Elementary): bigint | null {
  const name = type.name.replace(/^L/, '');
  const parts = /^(?:(\d{1,4}-\d{1,2}-\d{1,2}))?(-)?(?:(\d{1,2}:\d{1,2}(?::\d{1,2}(?:\.\d+)?)?))?$/.exec(body);
  if (parts === null) return null;
  const [, day, dash, clock] = parts;
  const wanted = name === 'DATE' ? [true, false] : name === 'TOD' ? [false, true] : [true, true];
  const given = [day !== undefined, clock !== undefined];
  if (given.join() !== wanted.join() || (dash !== undefined) !== (name === 'DT')) return null;
  const days = day === undefined ? 0n : daysOf(day);
  const [seconds, fraction] = clock === undefined ? [0n, ''] : (clockOf(clock) ?? [null, '']);
  if (days === null || seconds === null) return null;
  const precision = type.size === 8 ? 9 : name === 'TOD' ? 3 : 0;
  const finer = fraction.slice(precision);
  if (name === 'TOD' && /[1-9]/.test(finer)) return null;
  const ticks = BigInt(fraction.slice(0, precision).padEnd(precision, '0') || '0');
  return (days * DAY + seconds) * 10n ** BigInt(precision) + ticks;
}

/** Days since 1970-01-01; null for a day that there is not. */
function daysOf(text: string): bigint | null {
  const [year = 0, month = 0, day = 0] = text.split('-').map(Number);
  const date = new Date(Date.UTC(year, month - 1, day));
  if (year < 1970 || date.getUTCMonth() !== month - 1 || date.getUTCDate() !== day) return null;
  return BigInt(date.getTime() / 86_400_000);
}

/** Seconds since midnight, and the digits of their fraction. */
function clockOf(text: string): [bigint, string] | null {
  const [hour = '0', minute = '0', rest = '0'] = text.split(':');
  const [second = '0', fraction = ''] = rest.split('.');
  if (Number(hour) > 23 || Number(minute) > 59 || Number(second) > 59) return null;
  return [BigInt(hour) * 3600n + BigInt(minute) * 60n + BigInt(second), fraction];
}
