import { expect, it } from 'vitest';
import { momentAt, timeText } from './motion';

const SAMPLES = {
  time: [1, 2, 4],
  place: [
    [0, 0, 0],
    [10, 0, 0],
    [10, 20, 4],
  ],
  velocity: [0, 10, 10],
  acceleration: [5, 0, 0],
  line: [0, 0, 3],
  duration: 4,
  fault: null,
};

it('a motion is where it is between two samples, and stays at its ends', () => {
  expect(momentAt(SAMPLES, 1.5)).toEqual({ place: [5, 0, 0], velocity: 5, acceleration: 2.5, line: 0 });
  expect(momentAt(SAMPLES, 3)!.place).toEqual([10, 10, 2]);
  expect(momentAt(SAMPLES, 0)!.place).toEqual([0, 0, 0]);
  expect(momentAt(SAMPLES, 9)).toMatchObject({ place: [10, 20, 4], line: 3 });
  expect(momentAt({ ...SAMPLES, time: [] }, 1)).toBeNull();
});

it('times are read as on a clock', () => {
  expect(timeText(3.721)).toBe('3.72 s');
  expect(timeText(75.5)).toBe('1:15.50');
  expect(timeText(60)).toBe('1:00.00');
});
