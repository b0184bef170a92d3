/** Values as text: IEC literals in the number format of the view, short enough to stand still. */
import type { NumberFormat } from '@/text/settings';
import type { PlcValue, SubscribedItem } from './item';
import { valueKind, type ValueKind } from './item';

type FormatItem = Pick<SubscribedItem, 'kind' | 'type' | 'size' | 'enum' | 'bit' | 'flags'>;

const FIXED_FORMATS: readonly NumberFormat[] = ['dec', 'hex', 'bin'];
const WHOLE: ReadonlySet<ValueKind> = new Set<ValueKind>(['int', 'uint', 'bits', 'pointer']);

/** Full value as an IEC literal; exact, so that it can be typed in again. */
export function formatLiteral(value: PlcValue, item: FormatItem, format: NumberFormat = 'dec'): string {
  const kind = valueKind(item);
  if (typeof value === 'boolean') return value ? 'TRUE' : 'FALSE';
  if (typeof value === 'string') return quoted(value, kind === 'wstring');
  switch (kind) {
    case 'real':
      return formatReal(Number(value), item.size, format);
    case 'enum':
      return enumName(value, item) ?? String(value);
    case 'time':
      return formatDuration(BigInt(value) * 1_000_000n, 'T#', 'ms');
    case 'ltime':
      return formatDuration(BigInt(value), 'LTIME#', 'ns');
    case 'date':
      return `D#${day(BigInt(value))}`;
    case 'ldate':
      return `LDATE#${day(BigInt(value) / 1_000_000_000n)}`;
    case 'tod':
      return `TOD#${clock(BigInt(value) * 1_000_000n)}`;
    case 'ltod':
      return `LTOD#${clock(BigInt(value))}`;
    case 'dt':
      return `DT#${day(BigInt(value))}-${clock((BigInt(value) % 86_400n) * 1_000_000_000n)}`;
    case 'ldt':
      return `LDT#${day(BigInt(value) / 1_000_000_000n)}-${clock(BigInt(value) % 86_400_000_000_000n)}`;
    default:
      return formatWhole(value, item.size, kind === 'pointer' ? 'hex' : format);
  }
}

/**
 * What a pill or a narrow cell shows: floats rounded to seven digits, long texts cut with an ellipsis, whole numbers in
 * the format that attribute 'displaymode' of the variable fixes (LPRG-21), or else in that of the view.
 */
export function formatShort(value: PlcValue, item: FormatItem, format: NumberFormat = 'dec', length = 32): string {
  const kind = valueKind(item);
  if (kind === 'real' && typeof value === 'number' && format !== 'sci') return shortReal(value);
  const text = formatLiteral(value, item, (WHOLE.has(kind) ? fixedFormat(item) : null) ?? format);
  return text.length <= length ? text : `${text.slice(0, length - 1)}\u2026`;
}

function fixedFormat(item: FormatItem): NumberFormat | null {
  const flags = item.flags ?? [];
  return FIXED_FORMATS.find((format) => flags.includes(`DISPLAY_${format.toUpperCase()}`)) ?? null;
}

/** Every format of a value, for the tooltip. */
export function formatAll(value: PlcValue, item: FormatItem): { format: NumberFormat; text: string }[] {
  const kind = valueKind(item);
  const formats: readonly NumberFormat[] = WHOLE.has(kind)
    ? ['dec', 'hex', 'bin']
    : kind === 'real'
      ? ['dec', 'sci']
      : ['dec'];
  return formats.map((format) => ({
    format,
    text: kind === 'pointer' && format === 'dec' ? String(value) : formatLiteral(value, item, format),
  }));
}

/** Name of an enumeration value, or null when the number has none. */
function enumName(value: PlcValue, item: Pick<SubscribedItem, 'enum'>): string | null {
  for (const [name, number] of Object.entries(item.enum ?? {})) if (BigInt(number) === BigInt(value)) return name;
  return null;
}

function formatWhole(value: number | bigint, size: number, format: NumberFormat): string {
  if (format !== 'hex' && format !== 'bin') return String(value);
  const raw = BigInt.asUintN(size * 8, BigInt(value));
  if (format === 'hex')
    return `16#${raw
      .toString(16)
      .toUpperCase()
      .padStart(size * 2, '0')}`;
  const digits = raw.toString(2).padStart(size * 8, '0');
  return `2#${digits.replace(/(?<=\d)(?=(?:\d{4})+$)/g, '_')}`;
}

function formatReal(value: number, size: number, format: NumberFormat): string {
  if (!Number.isFinite(value)) return specialReal(value);
  if (format === 'sci')
    return value
      .toExponential(size === 4 ? 7 : 15)
      .replace('e', 'E')
      .replace('E+', 'E');
  if (value === 0) return Object.is(value, -0) ? '-0.0' : '0.0';
  const text = size === 4 ? shortestFloat(value) : String(value);
  return withPoint(text);
}

/** Fewest digits that still give the same 32-bit float. */
function shortestFloat(value: number): string {
  for (let digits = 6; digits <= 9; digits += 1) {
    const text = value.toPrecision(digits);
    if (Math.fround(Number(text)) === value) return String(Number(text));
  }
  return String(value);
}

function shortReal(value: number): string {
  if (!Number.isFinite(value)) return specialReal(value);
  if (value === 0) return '0.0';
  const magnitude = Math.abs(value);
  if (magnitude >= 1e9 || magnitude < 1e-4) return value.toExponential(4).replace('e', 'E').replace('E+', 'E');
  return withPoint(String(Number(value.toPrecision(7))));
}

function specialReal(value: number): string {
  return Number.isNaN(value) ? 'NaN' : value > 0 ? '+Inf' : '-Inf';
}

function withPoint(text: string): string {
  if (text.includes('e')) return text.replace('e+', 'E').replace('e', 'E');
  return text.includes('.') ? text : `${text}.0`;
}

/** Nanoseconds of each unit below a day. */
const UNITS: readonly [string, number][] = [
  ['h', 3_600_000_000_000],
  ['m', 60_000_000_000],
  ['s', 1_000_000_000],
  ['ms', 1_000_000],
  ['us', 1_000],
  ['ns', 1],
];
const DAY_NS = 86_400_000_000_000n;

function formatDuration(ns: bigint, prefix: string, smallest: 'ms' | 'ns'): string {
  const whole = ns < 0n ? -ns : ns;
  const days = whole / DAY_NS;
  // What is left of a day is exact as a number, and numbers are quicker.
  let rest = Number(whole % DAY_NS);
  let text = days > 0n ? `${String(days)}d` : '';
  for (const [unit, length] of UNITS) {
    const count = Math.floor(rest / length);
    rest -= count * length;
    if (count > 0) text += `${String(count)}${unit}`;
    if (unit === smallest) break;
  }
  return `${ns < 0n ? '-' : ''}${prefix}${text === '' ? `0${smallest}` : text}`;
}

function day(seconds: bigint): string {
  return new Date(Number(seconds) * 1000).toISOString().slice(0, 10);
}

function clock(ns: bigint): string {
  const two = (n: bigint) => String(n).padStart(2, '0');
  const seconds = ns / 1_000_000_000n;
  const fraction = String(ns % 1_000_000_000n)
    .padStart(9, '0')
    .replace(/0+$/, '');
  const time = `${two((seconds / 3600n) % 24n)}:${two((seconds / 60n) % 60n)}:${two(seconds % 60n)}`;
  return fraction === '' ? time : `${time}.${fraction}`;
}

const ESCAPES: Readonly<Record<string, string>> = { $: '$$', '\n': '$N', '\r': '$R', '\t': '$T', '\f': '$P' };

function quoted(value: string, wide: boolean): string {
  const quote = wide ? '"' : "'";
  let text = '';
  for (let at = 0; at < value.length; at += 1) {
    const c = value.charAt(at);
    const code = value.charCodeAt(at);
    if (c === quote) text += `$${quote}`;
    else if (ESCAPES[c] !== undefined) text += ESCAPES[c];
    else if (code < 32 || code === 127)
      text += `$${code
        .toString(16)
        .toUpperCase()
        .padStart(wide ? 4 : 2, '0')}`;
    else text += c;
  }
  return quote + text + quote;
}
