/** Derivative and integral of sampled curves. Time in nanoseconds; a value that is not a number is a gap. */

const PER_SECOND = 1e9;

/** The slope per second: by both neighbours, weighted for uneven distances (second order), by one at an edge or a gap. */
export function derivative(time: ArrayLike<number>, values: ArrayLike<number>): Float64Array {
  const n = values.length;
  const slope = new Float64Array(n).fill(NaN);
  for (let i = 0; i < n; i += 1) {
    const value = values[i]!;
    const before = i > 0 && !Number.isNaN(values[i - 1]);
    const after = i + 1 < n && !Number.isNaN(values[i + 1]);
    if (Number.isNaN(value)) continue;
    const h0 = before ? (time[i]! - time[i - 1]!) / PER_SECOND : 0;
    const h1 = after ? (time[i + 1]! - time[i]!) / PER_SECOND : 0;
    const s0 = h0 > 0 ? (value - values[i - 1]!) / h0 : NaN;
    const s1 = h1 > 0 ? (values[i + 1]! - value) / h1 : NaN;
    if (h0 > 0 && h1 > 0) slope[i] = (s0 * h1 + s1 * h0) / (h0 + h1);
    else slope[i] = h0 > 0 ? s0 : s1;
  }
  return slope;
}

/** The area below the curve in value times seconds, by trapezoids, from zero; over a gap it stays. */
export function integral(time: ArrayLike<number>, values: ArrayLike<number>): Float64Array {
  const n = values.length;
  const area = new Float64Array(n).fill(NaN);
  let sum = 0;
  for (let i = 0; i < n; i += 1) {
    const value = values[i]!;
    if (Number.isNaN(value)) continue;
    if (i > 0 && !Number.isNaN(values[i - 1]))
      sum += ((value + values[i - 1]!) / 2) * ((time[i]! - time[i - 1]!) / PER_SECOND);
    area[i] = sum;
  }
  return area;
}
