/** Two runs side by side: one brought to the times of the other, their difference, and by how much they are apart. */
import { lowerBound } from './statistics';

/** The curve at other times, straight between its samples; no number outside of it and in gaps. */
export function resampled(time: ArrayLike<number>, values: ArrayLike<number>, at: ArrayLike<number>): Float64Array {
  return Float64Array.from({ length: at.length }, (_, k) => {
    const moment = at[k]!;
    const next = lowerBound(time, moment);
    if (next < time.length && time[next] === moment) return values[next]!;
    if (next === 0 || next === time.length) return NaN;
    const part = (moment - time[next - 1]!) / (time[next]! - time[next - 1]!);
    return values[next - 1]! + part * (values[next]! - values[next - 1]!);
  });
}

interface Run {
  time: ArrayLike<number>;
  values: ArrayLike<number>;
}

/** The first run less the second one, which is moved by `shift` nanoseconds, at the times of the first. */
export function difference(one: Run, other: Run, shift: number): Float64Array {
  const moved = Float64Array.from({ length: other.time.length }, (_, k) => other.time[k]! + shift);
  const values = resampled(moved, other.values, one.time);
  return values.map((value, k) => one.values[k]! - value);
}

const GRID = 2048;

/**
 * By how much the second run has to be moved so that it lies on the first: the greatest correlation of the two, each
 * less its mean, up to half the length of the first, then to the sample. Null where nothing tells (no overlap, or a
 * straight line).
 */
export function bestShift(one: Run, other: Run): number | null {
  if (one.time.length < 2 || other.time.length < 2) return null;
  const start = one.time[0]!;
  const span = one.time[one.time.length - 1]! - start;
  const step = span / GRID;
  if (!(step > 0)) return null;
  const grid = (from: number) => Float64Array.from({ length: GRID + 1 }, (_, k) => from + k * step);
  const a = resampled(one.time, one.values, grid(start));
  const b = resampled(other.time, other.values, grid(other.time[0]!));
  let best: { score: number; lag: number } | null = null;
  for (let lag = -GRID / 2; lag <= GRID / 2; lag += 1) {
    const score = correlation(a, b, lag);
    if (score !== null && (best === null || score > best.score + 1e-12)) best = { score, lag };
  }
  if (best === null) return null;
  return refined(one, other, best.lag * step, step) + start - other.time[0]!;
}

/** The multiple of the distance of samples, within a step of `coarse`, that leaves the smallest difference. */
function refined(one: Run, other: Run, coarse: number, step: number): number {
  const interval = (one.time[one.time.length - 1]! - one.time[0]!) / (one.time.length - 1);
  const [first, last] = [Math.ceil((coarse - step) / interval), Math.floor((coarse + step) / interval)];
  let best = { apart: Infinity, shift: coarse };
  for (let number = first; number <= last; number += 1) {
    const shift = number * interval;
    const apart = deviation(difference(one, other, shift + one.time[0]! - other.time[0]!));
    if (apart < best.apart) best = { apart, shift };
  }
  return best.shift;
}

/** Mean square of the numbers less their mean. */
function deviation(values: Float64Array): number {
  let [n, sum, squares] = [0, 0, 0];
  for (const value of values) {
    if (Number.isNaN(value)) continue;
    n += 1;
    sum += value;
    squares += value * value;
  }
  return n === 0 ? Infinity : squares / n - (sum / n) ** 2;
}

/** Pearson's coefficient of a(k + lag) and b(k) over where both are numbers; null below a quarter of overlap. */
function correlation(a: Float64Array, b: Float64Array, lag: number): number | null {
  let [n, sa, sb, saa, sbb, sab] = [0, 0, 0, 0, 0, 0];
  for (let k = Math.max(0, -lag); k < Math.min(b.length, a.length - lag); k += 1) {
    const [x, y] = [a[k + lag]!, b[k]!];
    if (Number.isNaN(x) || Number.isNaN(y)) continue;
    n += 1;
    sa += x;
    sb += y;
    saa += x * x;
    sbb += y * y;
    sab += x * y;
  }
  if (n < a.length / 4) return null;
  const spread = (saa - (sa * sa) / n) * (sbb - (sb * sb) / n);
  return spread > 1e-18 * saa * sbb ? (sab - (sa * sb) / n) / Math.sqrt(spread) : null;
}
