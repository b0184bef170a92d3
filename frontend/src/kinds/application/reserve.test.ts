import { describe, expect, it } from 'vitest';
import type { Schemas } from '@/api/types';
import { leastFault, percentFault, usableReserve } from './reserve';

const application = (percent: number, least_kib: number) =>
  ({ change_reserve: { percent, least_kib } }) as Schemas['ApplicationData'];

describe('the memory for online changes', () => {
  it.each([
    [0, null],
    [1000, null],
    [-1, 'application.reservePercentFault'],
    [1001, 'application.reservePercentFault'],
    [2.5, 'application.reservePercentFault'],
    [Number.NaN, 'application.reservePercentFault'],
  ])('%s percent', (percent, fault) => expect(percentFault(percent)).toBe(fault));

  it('is whole KiB', () => {
    expect(leastFault(1_048_576)).toBeNull();
    expect(leastFault(1_048_577)).toBe('application.reserveLeastFault');
  });

  it('is usual where nothing is said', () => {
    expect(usableReserve({})).toBe(true);
    expect(usableReserve(application(50, 0))).toBe(true);
    expect(usableReserve(application(50, -1))).toBe(false);
  });
});
