/** What cursors measure and statistics say about a part of a curve. Gaps (no number) do not count. */

export interface Statistics {
  count: number;
  min: number;
  max: number;
  mean: number;
  /** Root of the mean square. */
  rms: number;
  /** Of the population. */
  deviation: number;
  peakToPeak: number;
}

/** Null where there is no value between the indices `from` and `to` (exclusive). */
export function statistics(values: ArrayLike<number>, from = 0, to = values.length): Statistics | null {
  let count = 0;
  let min = Infinity;
  let max = -Infinity;
  let mean = 0;
  let spread = 0;
  for (let i = from; i < to; i += 1) {
    const value = values[i]!;
    if (Number.isNaN(value)) continue;
    count += 1;
    min = Math.min(min, value);
    max = Math.max(max, value);
    // Welford 1962: no difference of large sums.
    const off = value - mean;
    mean += off / count;
    spread += off * (value - mean);
  }
  if (count === 0) return null;
  const variance = spread / count;
  return {
    count,
    min,
    max,
    mean,
    rms: Math.sqrt(mean * mean + variance),
    deviation: Math.sqrt(variance),
    peakToPeak: max - min,
  };
}

/** Index of the first of the sorted times that is not below `at`. */
export function lowerBound(time: ArrayLike<number>, at: number): number {
  let [low, high] = [0, time.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (time[middle]! < at) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Index of the sample that is nearest to a moment, null where there is none. */
export function nearestSample(time: ArrayLike<number>, at: number): number | null {
  if (time.length === 0) return null;
  const next = lowerBound(time, at);
  if (next === 0) return 0;
  if (next === time.length) return next - 1;
  return at - time[next - 1]! <= time[next]! - at ? next - 1 : next;
}

/** What one cursor shows of a curve: the sample that was valid then, as a controller holds its values. */
export function valueAt(time: ArrayLike<number>, values: ArrayLike<number>, at: number): number | null {
  const after = lowerBound(time, at);
  const index = after < time.length && time[after] === at ? after : after - 1;
  const value = values[index];
  return index < 0 || value === undefined || Number.isNaN(value) ? null : value;
}

export interface Measurement {
  /** At the cursors, null where there is no value. */
  first: number | null;
  second: number | null;
  /** Second less first. */
  difference: number | null;
  /** Per second. */
  slope: number | null;
  /** Between the cursors, both included. */
  between: Statistics | null;
}

/** What two cursors measure of a curve (TRC-81); `first` and `second` in nanoseconds, in any order. */
export function measure(
  time: ArrayLike<number>,
  values: ArrayLike<number>,
  first: number,
  second: number,
): Measurement {
  const [one, two] = [valueAt(time, values, first), valueAt(time, values, second)];
  const difference = one === null || two === null ? null : two - one;
  const seconds = (second - first) / 1e9;
  const from = lowerBound(time, Math.min(first, second));
  const last = Math.max(first, second);
  let to = lowerBound(time, last);
  while (to < time.length && time[to] === last) to += 1;
  return {
    first: one,
    second: two,
    difference,
    slope: difference === null || seconds === 0 ? null : difference / seconds,
    between: statistics(values, from, to),
  };
}
