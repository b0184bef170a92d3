/** Durations as IEC 61131-3 writes them: `T#1h30m`, `T#2s500ms`. */

/** Name, nanoseconds, and the most of a unit that is not the first one. From large to small. */
const UNITS: readonly (readonly [string, bigint, number])[] = [
  ['d', 86_400_000_000_000n, Infinity],
  ['h', 3_600_000_000_000n, 23],
  ['m', 60_000_000_000n, 59],
  ['s', 1_000_000_000n, 59],
  ['ms', 1_000_000n, 999],
  ['us', 1_000n, 999],
  ['ns', 1n, Infinity],
];

export interface ExactDuration {
  /** Nanoseconds times `scale`. */
  readonly total: bigint;
  /** A power of ten. */
  readonly scale: bigint;
  /** The smallest unit. */
  readonly unit: string;
}

/**
 * What stands behind the # of a duration, exact (LTYP-33): units from large to small, each once; only the last number may
 * have a fraction. Null when it is none.
 */
export function exactDuration(text: string): ExactDuration | null {
  const body = text.replaceAll('_', '').toLowerCase();
  const parts = [...body.matchAll(/(\d+)(?:\.(\d+))?([a-z]+)/g)];
  if (parts.length === 0 || parts.map((part) => part[0]).join('') !== body) return null;
  let total = 0n;
  let scale = 1n;
  let before = -1;
  for (const [index, [, digits = '', fraction = '', unit]] of parts.entries()) {
    const rank = UNITS.findIndex(([name]) => name === unit);
    if (rank <= before || (fraction !== '' && index < parts.length - 1)) return null;
    const [, length, most] = UNITS[rank]!;
    if (index > 0 && Number(digits) > most) return null;
    scale = 10n ** BigInt(fraction.length);
    total = total * scale + BigInt(digits + fraction) * length;
    before = rank;
  }
  return { total, scale, unit: UNITS[before]![0] };
}

/** Nanoseconds of a TIME literal such as `t#1s500ms`, rounded; null when it is none. */
export function timeLiteral(text: string): number | null {
  const match = /^(?:l?time|lt|t)#(.+)$/i.exec(text.trim());
  const found = match && exactDuration(match[1]!);
  return found ? Math.round(Number(found.total) / Number(found.scale)) : null;
}

/** A duration as TIME literal, with a sign where it is negative; what is below a nanosecond is rounded away. */
export function durationText(ns: number): string {
  let rest = Math.round(Math.abs(ns));
  if (rest === 0) return 'T#0s';
  let text = '';
  for (const [unit, length] of UNITS) {
    const size = Number(length);
    const count = Math.floor(rest / size);
    if (count > 0) text += `${count}${unit}`;
    rest -= count * size;
  }
  return `T#${ns < 0 ? '-' : ''}${text}`;
}

/** Nanoseconds of a TIME literal that may be negative (`T#-5s`); null when it is none. */
export function signedDuration(text: string): number | null {
  const match = /^(\w+#)-(.+)$/.exec(text.trim());
  if (!match) return timeLiteral(text);
  const ns = timeLiteral(match[1]! + match[2]!);
  return ns === null ? null : -ns;
}
