/** Literals a user types as prepared value: read by the variable's type, refused with a reason (DECL-43). */
import type { TextKey, TextValues } from '@/i18n';
import { valueKind, type SubscribedItem } from './item';

export type LiteralResult =
  | { readonly ok: true; readonly literal: string }
  | { readonly ok: false; readonly reason: TextKey; readonly values: TextValues };

type LiteralItem = Pick<SubscribedItem, 'kind' | 'type' | 'size' | 'enum' | 'bit'>;

const good = (literal: string): LiteralResult => ({ ok: true, literal });
const bad = (reason: TextKey, values: TextValues = {}): LiteralResult => ({ ok: false, reason, values });

/** Checks `text` for a variable of `item`'s type; the result's literal is in IEC spelling. */
export function checkLiteral(text: string, item: LiteralItem): LiteralResult {
  const plain = text.trim();
  const type = item.type;
  switch (valueKind(item)) {
    case 'bool':
      return checkBool(plain);
    case 'int':
    case 'uint':
    case 'bits':
      return checkWhole(plain, item);
    case 'real':
      return checkReal(plain, item);
    case 'time':
    case 'ltime':
      return checkDuration(plain, item);
    case 'date':
    case 'ldate':
      return checkPattern(plain, /^(L?D|L?DATE)#\d{4}-\d{1,2}-\d{1,2}$/i, type, 'D#2024-12-31');
    case 'tod':
    case 'ltod':
      return checkPattern(
        plain,
        /^(L?TOD|L?TIME_OF_DAY)#\d{1,2}:\d{1,2}(:\d{1,2}(\.\d+)?)?$/i,
        type,
        'TOD#15:36:30.123',
      );
    case 'dt':
    case 'ldt':
      return checkPattern(
        plain,
        /^(L?DT|L?DATE_AND_TIME)#\d{4}-\d{1,2}-\d{1,2}-\d{1,2}:\d{1,2}(:\d{1,2}(\.\d+)?)?$/i,
        type,
        'DT#2024-12-31-15:36:30',
      );
    case 'enum':
      return checkEnum(plain, item);
    case 'string':
      return checkString(plain, "'", item);
    case 'wstring':
      return checkString(plain, '"', item);
    case 'pointer':
      return checkWhole(plain, { ...item, kind: 'uint' });
    case 'compound':
    case 'error':
      return bad('online.literal.compound', { type });
  }
}

function checkBool(text: string): LiteralResult {
  const upper = text.toUpperCase().replace(/^BOOL#/, '');
  if (upper === 'TRUE' || upper === '1') return good('TRUE');
  if (upper === 'FALSE' || upper === '0') return good('FALSE');
  return bad('online.literal.bool', { text });
}

const BASES: Readonly<Record<string, RegExp>> = { '2': /^[01]+$/, '8': /^[0-7]+$/, '16': /^[0-9A-F]+$/ };
const BASE_PREFIX: Readonly<Record<string, string>> = { '2': '0b', '8': '0o', '16': '0x' };

/** The number of an integer literal in any base, or null when it is none. */
export function wholeNumber(text: string): bigint | null {
  const upper = text
    .trim()
    .toUpperCase()
    .replace(/_/g, '')
    .replace(/^[A-Z]+#/, '');
  const sign = upper.startsWith('-') ? -1n : 1n;
  const digits = upper.replace(/^[+-]/, '');
  const based = /^(2|8|16)#(.+)$/.exec(digits);
  if (based !== null) {
    const [, base = '', number = ''] = based;
    return BASES[base]?.test(number) ? sign * BigInt((BASE_PREFIX[base] ?? '') + number) : null;
  }
  return /^\d+$/.test(digits) ? sign * BigInt(digits) : null;
}

/** Smallest and largest number of an integer type of this size. */
function wholeRange(size: number, signed: boolean): readonly [bigint, bigint] {
  const bits = BigInt(size * 8);
  return signed ? [-(1n << (bits - 1n)), (1n << (bits - 1n)) - 1n] : [0n, (1n << bits) - 1n];
}

function checkWhole(text: string, item: LiteralItem): LiteralResult {
  const number = wholeNumber(text);
  if (number === null) return bad('online.literal.whole', { text, type: item.type });
  const [low, high] = wholeRange(item.size, valueKind(item) === 'int');
  if (number < low || number > high) {
    return bad('online.literal.range', { text, type: item.type, low: String(low), high: String(high) });
  }
  return good(text.toUpperCase().replace(/^[+]/, ''));
}

function checkReal(text: string, item: LiteralItem): LiteralResult {
  const plain = text
    .toUpperCase()
    .replace(/_/g, '')
    .replace(/^L?REAL#/, '');
  if (!/^[+-]?(\d+(\.\d*)?|\.\d+)(E[+-]?\d+)?$/.test(plain))
    return bad('online.literal.real', { text, type: item.type });
  const number = Number(plain);
  const limit = item.size === 4 ? 3.402823466e38 : Number.MAX_VALUE;
  if (!(Math.abs(number) <= limit)) {
    return bad('online.literal.range', { text, type: item.type, low: `-${String(limit)}`, high: String(limit) });
  }
  const literal = plain
    .replace(/^\+/, '')
    .replace(/^(-?)\./, '$10.')
    .replace(/\.(?=E|$)/, '.0');
  return good(literal.includes('.') || literal.includes('E') ? literal : `${literal}.0`);
}

const UNITS = ['d', 'h', 'm', 's', 'ms', 'us', 'ns'] as const;

/** Units in falling order, each at most once; only the first may exceed its limit (LTYP-33). */
function checkDuration(text: string, item: LiteralItem): LiteralResult {
  const long = valueKind(item) === 'ltime';
  const example = long ? 'LTIME#1s500ms20us' : 'T#1s500ms';
  const match = /^(T|TIME|LT|LTIME)#(.+)$/i.exec(text.replace(/_/g, ''));
  const body = match === null ? text : (match[2] ?? '');
  const refuse = bad('online.literal.pattern', { text, type: item.type, example });
  const parts = [...body.toLowerCase().matchAll(/(\d+(?:\.\d+)?)(ms|us|ns|d|h|m|s)/g)];
  if (parts.length === 0 || parts.map((p) => p[0]).join('') !== body.toLowerCase()) return refuse;
  let before = -1;
  for (const part of parts) {
    const unit = UNITS.indexOf(part[2] as (typeof UNITS)[number]);
    if (unit <= before || (!long && unit > UNITS.indexOf('ms'))) return refuse;
    before = unit;
  }
  const limits = { d: Infinity, h: 24, m: 60, s: 60, ms: 1000, us: 1000, ns: long ? Infinity : 1000 };
  const late = parts.slice(1).some((p) => Number(p[1]) >= limits[p[2] as (typeof UNITS)[number]]);
  if (late) return refuse;
  return good(`${long ? 'LTIME#' : 'T#'}${body.toLowerCase()}`);
}

function checkPattern(text: string, pattern: RegExp, type: string, example: string): LiteralResult {
  return pattern.test(text) ? good(text.toUpperCase()) : bad('online.literal.pattern', { text, type, example });
}

function checkEnum(text: string, item: LiteralItem): LiteralResult {
  const values = Object.entries(item.enum ?? {});
  const name = text.slice(text.lastIndexOf('.') + 1).toUpperCase();
  const named = values.find(([own]) => own.toUpperCase() === name);
  if (named !== undefined) return good(named[0]);
  const number = wholeNumber(text);
  const numbered = number === null ? undefined : values.find(([, n]) => BigInt(n) === number);
  if (numbered !== undefined) return good(numbered[0]);
  const names = values.slice(0, 6).map(([own]) => own);
  return bad('online.literal.enum', {
    text,
    type: item.type,
    names: names.join(', ') + (values.length > 6 ? ' \u2026' : ''),
  });
}

function checkString(text: string, quote: string, item: LiteralItem): LiteralResult {
  const inside = text.startsWith(quote) && text.endsWith(quote) && text.length >= 2 ? text.slice(1, -1) : text;
  const escapes = quote === "'" ? /\$(?:[$'LlNnPpRrTt]|[0-9A-Fa-f]{2})/g : /\$(?:[$"LlNnPpRrTt]|[0-9A-Fa-f]{4})/g;
  const rest = inside.replace(escapes, '_');
  if (rest.includes('$') || rest.includes(quote)) {
    return bad('online.literal.string', { text, quote });
  }
  const room = quote === '"' ? item.size / 2 - 1 : item.size - 1;
  if (rest.length > room) return bad('online.literal.long', { count: rest.length, room });
  if (quote === "'" && [...rest].some((c) => c > '\u00ff')) return bad('online.literal.narrow', { text });
  return good(quote + inside + quote);
}
