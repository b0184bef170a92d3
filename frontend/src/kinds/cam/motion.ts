/** The slave over the time of a master that moves at a constant velocity (cam.md section 1). Pure functions. */
import type { CamDrawing } from './curves';

export interface Limits {
  velocity: number;
  acceleration: number;
  deceleration: number;
  jerk: number;
}

export type Quantity = 'position' | 'velocity' | 'acceleration' | 'jerk';

export interface Motion {
  /** Seconds since the master was at the start of its range. */
  time: number[];
  position: number[];
  /** By the time, in units of the slave. */
  velocity: number[];
  acceleration: number[];
  jerk: number[];
}

/** `speed` of the master in its units per second, negative: backwards. By the chain rule v = V·s, a = A·s², j = J·s³. */
export function motionAt(drawing: CamDrawing, speed: number): Motion {
  const motion: Motion = { time: [], position: [], velocity: [], acceleration: [], jerk: [] };
  const segments = speed < 0 ? [...drawing.segments].reverse() : drawing.segments;
  const from = speed < 0 ? segments[0]?.x.at(-1) : segments[0]?.x[0];
  for (const segment of segments) {
    const order = segment.x.map((_, at) => (speed < 0 ? segment.x.length - 1 - at : at));
    for (const at of order) {
      motion.time.push((segment.x[at]! - from!) / speed + 0);
      motion.position.push(segment.y[at]!);
      motion.velocity.push(segment.v[at]! * speed);
      motion.acceleration.push(segment.a[at]! * speed ** 2);
      motion.jerk.push(segment.j[at]! * speed ** 3);
    }
  }
  return motion;
}

export interface Peaks {
  velocity: number;
  acceleration: number;
  jerk: number;
}

/** Largest absolute values by the position of the master, between the samples as well. */
export function peaksOf(drawing: CamDrawing): Peaks {
  const largest = (name: keyof Peaks) => Math.max(0, ...drawing.segments.map((segment) => segment[name]));
  return { velocity: largest('velocity'), acceleration: largest('acceleration'), jerk: largest('jerk') };
}

/** What the limits allow of the acceleration in both directions: the smaller one of acceleration and deceleration. */
export function accelerationLimit(limits: Limits): number {
  return Math.min(limits.acceleration, limits.deceleration);
}

/** The fastest master with which the slave keeps its limits; Infinity where nothing moves. */
export function fastestMaster(peaks: Peaks, limits: Limits): number {
  const within = (limit: number, peak: number, power: number) => (peak > 0 ? (limit / peak) ** (1 / power) : Infinity);
  return Math.min(
    within(limits.velocity, peaks.velocity, 1),
    within(accelerationLimit(limits), peaks.acceleration, 2),
    within(limits.jerk, peaks.jerk, 3),
  );
}
