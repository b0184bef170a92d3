/** Times of tasks as people read them. Pure functions. */

/** Microseconds in a width that stays calm: `0.8 µs`, `412 µs`, `1.25 ms`, `2.4 s`. */
export function microsText(us: number | null | undefined): string {
  if (us == null) return '–';
  const size = Math.abs(us);
  if (size < 10) return `${us.toFixed(1)} µs`;
  if (size < 1000) return `${us.toFixed(0)} µs`;
  if (size < 10_000) return `${(us / 1000).toFixed(2)} ms`;
  if (size < 1_000_000) return `${(us / 1000).toFixed(1)} ms`;
  return `${(us / 1_000_000).toFixed(1)} s`;
}

/** Microseconds as a plain number with one decimal, for columns whose head names the unit. */
export function microsNumber(us: number | null | undefined): string {
  return us == null ? '–' : us.toFixed(us < 100 ? 1 : 0);
}

/** Large counts in groups of three with thin spaces: `12 408 113`. */
export function countText(count: number): string {
  return String(count).replace(/\B(?=(\d{3})+(?!\d))/g, '\u202f');
}
