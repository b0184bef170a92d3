import { describe, expect, it } from 'vitest';
import type { CamDrawing } from './curves';
import { fastestMaster, motionAt, peaksOf } from './motion';

/** y = x² from 0 to 2, and on along its tangent to 3: v = 2x, a = 2, then v = 4. */
const drawing: CamDrawing = {
  at: [],
  findings: [],
  segments: [
    {
      x: [0, 1, 2],
      y: [0, 1, 4],
      v: [0, 2, 4],
      a: [2, 2, 2],
      j: [0, 0, 0],
      least: 0,
      greatest: 4,
      velocity: 4,
      acceleration: 2,
      jerk: 0,
    },
    {
      x: [2, 3],
      y: [4, 8],
      v: [4, 4],
      a: [0, 0],
      j: [0, 0],
      least: 4,
      greatest: 8,
      velocity: 4,
      acceleration: 0,
      jerk: 0,
    },
  ],
};

describe('the motion of the slave', () => {
  it('follows the chain rule', () => {
    expect(motionAt(drawing, 10)).toEqual({
      time: [0, 0.1, 0.2, 0.2, 0.3],
      position: [0, 1, 4, 4, 8],
      velocity: [0, 20, 40, 40, 40],
      acceleration: [200, 200, 200, 0, 0],
      jerk: [0, 0, 0, 0, 0],
    });
  });

  it('runs from the end to the start while the master moves backwards', () => {
    const motion = motionAt(drawing, -10);
    expect(motion.time.map((time) => Math.round(time * 1e9) / 1e9)).toEqual([0, 0.1, 0.1, 0.2, 0.3]);
    expect(motion.position).toEqual([8, 4, 4, 1, 0]);
    expect(motion.velocity.at(-2)).toBe(-20);
    expect(motion.acceleration.at(-1)).toBe(200);
  });

  it('is within its limits up to a velocity of the master', () => {
    const peaks = peaksOf(drawing);
    expect(peaks).toEqual({ velocity: 4, acceleration: 2, jerk: 0 });
    const limits = { velocity: 100, acceleration: 800, deceleration: 200, jerk: 1 };
    expect(fastestMaster(peaks, limits)).toBe(10);
    expect(fastestMaster({ ...peaks, velocity: 100 }, limits)).toBe(1);
    expect(fastestMaster({ velocity: 0, acceleration: 0, jerk: 0 }, limits)).toBe(Infinity);
  });
});
