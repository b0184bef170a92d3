import { describe, expect, it } from 'vitest';
import { USUAL_TIME_AXIS, USUAL_VALUE_AXIS, type TimeAxis, type ValueAxis } from '../configuration';
import { timeRange, valueScale } from './scaling';

const x = (change: Partial<TimeAxis>): TimeAxis => ({ ...USUAL_TIME_AXIS, ...change });
const y = (change: Partial<ValueAxis>): ValueAxis => ({ ...USUAL_VALUE_AXIS, ...change });
const S = 1e9;

describe('the time axis', () => {
  it('follows the buffer by itself (TRC-50)', () => {
    expect(timeRange(x({}), { min: 0, max: 30 * S }, 10 * S)).toEqual({ min: 20 * S, max: 30 * S });
    expect(timeRange(x({}), { min: 0, max: 3 * S }, 10 * S)).toEqual({ min: 0, max: 10 * S });
    expect(timeRange(x({}), null, 10 * S)).toEqual({ min: 0, max: 10 * S });
    expect(timeRange(x({}), { min: S, max: 5 * S }, 0)).toEqual({ min: S, max: 5 * S });
  });

  it('stands at a fixed range (TRC-51)', () => {
    const fixed = x({ mode: 'fixed', minimum: 'T#-1s', maximum: 'T#200s' });
    expect(timeRange(fixed, { min: 0, max: 900 * S }, 10 * S)).toEqual({ min: -S, max: 200 * S });
  });

  it('keeps the newest values in sight (TRC-52)', () => {
    const scrolling = x({ mode: 'scrolling', length: 'T#2m' });
    expect(timeRange(scrolling, { min: 0, max: 300 * S }, 10 * S)).toEqual({ min: 180 * S, max: 300 * S });
  });

  it('has a size also for one sample', () => {
    const { min, max } = timeRange(x({}), { min: 5 * S, max: 5 * S }, 0);
    expect([min, max]).toEqual([4.5 * S, 5.5 * S]);
  });
});

describe('the value axis (TRC-61)', () => {
  it('fits the values, is fixed, or keeps the newest maximum in sight', () => {
    expect(valueScale(y({}), { min: 0, max: 100 })).toEqual({ min: -6, max: 106 });
    expect(valueScale(y({ mode: 'fixed', minimum: -1, maximum: 1 }), { min: 0, max: 100 })).toEqual({
      min: -1,
      max: 1,
    });
    expect(valueScale(y({ mode: 'scrolling', length: 20 }), { min: 0, max: 100 })).toEqual({ min: 80, max: 100 });
    expect(valueScale(y({}), null)).toEqual({ min: 0, max: 1 });
  });
});
