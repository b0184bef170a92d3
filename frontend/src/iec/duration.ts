/** Durations as IEC 61131-3 writes them: `T#1h30m`, `T#2s500ms`. */

const UNITS: Record<string, number> = { d: 86_400e9, h: 3_600e9, m: 60e9, s: 1e9, ms: 1e6, us: 1e3, ns: 1 };

/** Nanoseconds of a TIME literal such as `t#1s500ms`; null when it is none. Units go from large to small, each once. */
export function timeLiteral(text: string): number | null {
  const match = /^(?:l?time|lt|t)#(.+)$/i.exec(text.trim());
  if (!match) return null;
  let rest = match[1]!.toLowerCase().replace(/_/g, '');
  let total = 0;
  let last = Infinity;
  while (rest !== '') {
    const part = /^(\d+(?:\.\d+)?)(ms|us|ns|d|h|m|s)/.exec(rest);
    if (!part) return null;
    const unit = UNITS[part[2]!]!;
    if (unit >= last) return null;
    last = unit;
    total += Number(part[1]) * unit;
    rest = rest.slice(part[0].length);
  }
  return Math.round(total);
}

const LARGE_TO_SMALL = Object.entries(UNITS);

/** A duration as TIME literal, with a sign where it is negative; what is below a nanosecond is rounded away. */
export function durationText(ns: number): string {
  let rest = Math.round(Math.abs(ns));
  if (rest === 0) return 'T#0s';
  let text = '';
  for (const [unit, size] of LARGE_TO_SMALL) {
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
