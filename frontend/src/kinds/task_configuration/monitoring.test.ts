import { describe, expect, it } from 'vitest';
import type { LoadOfTasks, TaskTimes } from '@/api/types';
import { bars, joinedLoad, loadSeries } from './monitoring';

const load = (...seconds: number[]): LoadOfTasks => ({
  tasks: ['Main', 'Slow'],
  processors: [0, 3],
  samples: seconds.map((second) => ({
    at: new Date(1_700_000_000_000 + second * 1000).toISOString(),
    tasks: [second, 0],
    processors: [50, 100 - second],
  })),
});
const times = (counts: Record<number, number>): TaskTimes => ({
  name: 'Main',
  classes: Array.from({ length: 128 }, (_, at) => ({ from_us: at, cycles: counts[at] ?? 0, starts: at === 0 ? 1 : 0 })),
});

describe('load', () => {
  it('gives each task and processor its curve over the last seconds', () => {
    const { ago, series } = loadSeries(load(1, 2, 9, 10), 5, (number) => `CPU ${String(number)}`);
    expect(ago).toEqual([-1, 0]);
    expect(series.map(({ name, of }) => [name, of])).toEqual([
      ['Main', 'task'],
      ['Slow', 'task'],
      ['CPU 0', 'processor'],
      ['CPU 3', 'processor'],
    ]);
    expect(series[0]!.values).toEqual([9, 10]);
    expect(series[3]!.values).toEqual([91, 90]);
  });
  it('is empty before the first sample', () => {
    expect(loadSeries(load(), 60, String)).toMatchObject({ ago: [] });
  });
  it('grows by new samples, and begins anew with other tasks', () => {
    expect(joinedLoad(load(1, 2), load(3), 10).samples).toHaveLength(3);
    expect(joinedLoad(load(1, 2), load(3), 2).samples.map((sample) => sample.tasks[0])).toEqual([2, 3]);
    const other = { ...load(3), tasks: ['Other'] };
    expect(joinedLoad(load(1, 2), other, 10)).toBe(other);
  });
});

describe('bars', () => {
  it('reach from the first to the last class that holds anything', () => {
    const shown = bars(times({ 40: 30, 60: 10 }), 'cycles');
    expect([shown.length, shown[0]!.fromUs, shown.at(-1)!.fromUs]).toEqual([21, 40, 60]);
    expect(shown[0]).toMatchObject({ toUs: 41, count: 30, share: 0.75, reached: 0.75 });
    expect(shown.at(-1)).toMatchObject({ share: 0.25, reached: 1 });
  });
  it('have some room around them where they are few, at the ends of the scale too', () => {
    expect(bars(times({ 50: 1 }), 'cycles')).toHaveLength(12);
    expect(bars(times({ 0: 1 }), 'starts')[0]!.count).toBe(1);
    const top = bars(times({ 127: 5 }), 'cycles');
    expect([top.length, top.at(-1)!.toUs]).toEqual([12, Infinity]);
  });
  it('are none where nothing was counted', () => {
    expect(bars(times({}), 'cycles')).toEqual([]);
  });
});
