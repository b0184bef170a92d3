/** The time axis of a trace in nanoseconds: ticks at round times, named by IEC literals (trace.md, TRC-51 to TRC-54). */
import type { Range } from '@/editors/plot/scales';
import { durationText } from '@/iec/duration';

const S = 1e9;
const MINUTE = 60 * S;
const HOUR = 60 * MINUTE;
const DAY = 24 * HOUR;
/** Above a second the round numbers are those of a clock. */
const CLOCK = [1, 2, 5, 10, 15, 30].flatMap((n) => [n * S, n * MINUTE]).concat([1, 2, 3, 6, 12].map((n) => n * HOUR));
const CLOCK_STEPS = [...CLOCK, DAY].sort((one, other) => one - other);

/** The smallest round step so that at most `count` of them fill the range. */
export function timeStep(range: Range, count: number): number {
  const rough = (range.max - range.min) / Math.max(1, count);
  if (!(rough > 0) || !Number.isFinite(rough)) return S;
  if (rough <= 0.5 * S || rough > DAY) {
    const unit = rough > DAY ? DAY : 1;
    const power = unit * Math.max(1, 10 ** Math.floor(Math.log10(rough / unit) + 1e-12));
    const part = rough / power;
    return (part <= 1.0000001 ? 1 : part <= 2.0000001 ? 2 : part <= 5.0000001 ? 5 : 10) * power;
  }
  return CLOCK_STEPS.find((step) => step >= rough * 0.9999999) ?? DAY;
}

/** The multiples of `step` within the range, at most `most` of them. */
export function timeTicks(range: Range, step: number, most = 2000): number[] {
  if (!(step > 0) || (range.max - range.min) / step > most) return [];
  const first = Math.ceil(range.min / step - 1e-9);
  const last = Math.floor(range.max / step + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, at) => (first + at) * step + 0);
}

/** How fine the times within a window of `span` nanoseconds are shown: about a thousandth of it, a power of ten. */
export function timeGrain(span: number): number {
  return Math.max(1, 10 ** Math.floor(Math.log10(Math.max(1, span)) - 3));
}

/** A moment as literal, no finer than `grain` nanoseconds. */
export function momentText(ns: number, grain = 1): string {
  return durationText(Math.round(ns / grain) * grain);
}

/** A frequency with its unit, for what stands in `hz`. */
export function frequencyText(hz: number): string {
  const [size, unit] = hz >= 1e6 ? [1e6, 'MHz'] : hz >= 1e3 ? [1e3, 'kHz'] : [1, 'Hz'];
  return `${Number((hz / size).toPrecision(5))} ${unit}`;
}

export const PER_SECOND = S;
