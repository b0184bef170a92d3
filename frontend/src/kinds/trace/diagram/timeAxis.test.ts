import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { durationText } from '@/iec/duration';
import { frequencyText, momentText, timeGrain, timeStep, timeTicks } from './timeAxis';

const steps = (seconds: number, count: number) => durationText(timeStep({ min: 0, max: seconds * 1e9 }, count));

describe('ticks of the time axis', () => {
  it('stand at round times', () => {
    expect(steps(10, 10)).toBe('T#1s');
    expect(steps(1, 10)).toBe('T#100ms');
    expect(steps(0.9, 6)).toBe('T#200ms');
    expect(steps(60, 8)).toBe('T#10s');
    expect(steps(90, 8)).toBe('T#15s');
    expect(steps(600, 8)).toBe('T#2m');
    expect(steps(3600, 8)).toBe('T#10m');
    expect(steps(86400, 8)).toBe('T#3h');
    expect(steps(10 * 86400, 8)).toBe('T#2d');
    expect(steps(3e-6, 5)).toBe('T#1us');
  });

  it('are no more than asked for, and at least a third of them', () => {
    fc.assert(
      fc.property(
        fc.double({ min: 100, max: 1e17, noNaN: true }),
        fc.double({ min: -1e15, max: 1e15, noNaN: true }),
        fc.integer({ min: 3, max: 20 }),
        (span, min, count) => {
          const range = { min, max: min + span };
          const step = timeStep(range, count);
          const ticks = timeTicks(range, step);
          expect(ticks.length).toBeLessThanOrEqual(count + 1);
          expect(ticks.length).toBeGreaterThanOrEqual(Math.floor(count / 3) - 1);
          expect(step).toBe(Math.round(step));
          for (const tick of ticks) expect(Math.round(tick / step) * step).toBe(tick);
        },
      ),
    );
  });

  it('are none where they would be a black bar', () => {
    expect(timeTicks({ min: 0, max: 1e9 }, 1)).toEqual([]);
    expect(timeTicks({ min: 0, max: 1e9 }, 0)).toEqual([]);
  });
});

describe('times as text', () => {
  it('are as fine as what is seen needs', () => {
    expect(momentText(1_234_567_891, timeGrain(10e9))).toBe('T#1s230ms');
    expect(momentText(1_234_567_891, timeGrain(1e6))).toBe('T#1s234ms568us');
    expect(momentText(12.4, timeGrain(100))).toBe('T#12ns');
  });

  it('have frequencies beside them', () => {
    expect([50, 1234.5, 2.5e6].map(frequencyText)).toEqual(['50 Hz', '1.2345 kHz', '2.5 MHz']);
  });
});
