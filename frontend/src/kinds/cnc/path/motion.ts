/** The interpolated motion on a path, between its samples. */
import type { PathSamples } from './pathView';
import type { Vector } from './projection';

export interface Moment {
  readonly place: Vector;
  readonly velocity: number;
  readonly acceleration: number;
  /** -1: none. */
  readonly line: number;
}

/** What is at a time; null where there are no samples. */
export function momentAt(samples: PathSamples, time: number): Moment | null {
  const { time: times, place, velocity, acceleration, line } = samples;
  if (times.length === 0) return null;
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle]! <= time) low = middle;
    else high = middle - 1;
  }
  const next = Math.min(low + 1, times.length - 1);
  const width = times[next]! - times[low]!;
  const share = width > 0 ? Math.min(1, Math.max(0, (time - times[low]!) / width)) : 0;
  const between = (a: number, b: number) => a + share * (b - a);
  const [from, to] = [place[low]!, place[next]!];
  return {
    place: [between(from[0]!, to[0]!), between(from[1]!, to[1]!), between(from[2]!, to[2]!)],
    velocity: between(velocity[low]!, velocity[next]!),
    acceleration: between(acceleration[low]!, acceleration[next]!),
    line: line[low]!,
  };
}

/** Speeds at which a motion can be played, as factors of real time. */
export const SPEEDS = ['0.1', '0.5', '1', '2', '10', '100'] as const;
export type Speed = (typeof SPEEDS)[number];

export function timeText(seconds: number): string {
  const minutes = Math.floor(seconds / 60);
  const rest = (seconds - 60 * minutes).toFixed(2);
  return minutes > 0 ? `${String(minutes)}:${rest.padStart(5, '0')}` : `${rest} s`;
}
