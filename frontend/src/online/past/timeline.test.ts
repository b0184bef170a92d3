import { describe, expect, it } from 'vitest';
import { t } from '@/i18n';
import { momentText, pastText, spanText } from '@/workbench/online/pastText';
import { indexAt, momentOf, pastMoment, stepped, ticksOf } from './timeline';

const every10ms = Array.from({ length: 301 }, (_, at) => ({ cycle: 1000 + at, at: 5000 + at * 10 }));

describe('moments', () => {
  it('keep microseconds, which a Date has not', () => {
    expect(momentOf({ cycle: 3, timestamp: '1970-01-01T00:00:01.234567Z' }).at).toBeCloseTo(1234.567, 6);
    expect(momentOf({ cycle: 3, timestamp: '1970-01-01T00:00:01Z' }).at).toBe(1000);
    expect(momentOf({ cycle: 3, timestamp: '1970-01-01T00:00:01.5Z' }).at).toBe(1500);
  });

  it('are found by their time as a look at each of them finds them', () => {
    const uneven = [3, 4, 9, 9.5, 40, 41, 100].map((at, cycle) => ({ cycle, at }));
    for (let time = 0; time < 110; time += 0.5) {
      const ended = uneven.filter((moment) => moment.at <= time).length;
      expect(indexAt(uneven, time), String(time)).toBe(Math.max(ended - 1, 0));
    }
  });

  it('are stepped through from the present, and no further than they reach', () => {
    expect(stepped(5, null, -1)).toBe(4);
    expect(stepped(5, 4, -1)).toBe(3);
    expect(stepped(5, 0, -1)).toBe(0);
    expect(stepped(5, 4, 1)).toBe(4);
    expect(stepped(5, null, -100)).toBe(0);
    expect(stepped(0, null, -1)).toBeNull();
  });
});

describe('ticks', () => {
  it('stand at round spans before the end, as many as there is room for', () => {
    expect(ticksOf(every10ms, 10).map((tick) => tick.before)).toEqual([0, 500, 1000, 1500, 2000, 2500, 3000]);
    for (const { index, before } of ticksOf(every10ms, 10)) expect(index).toBe(300 - before / 10);
    for (let most = 1; most < 40; most += 1) {
      const ticks = ticksOf(every10ms, most);
      expect(ticks.length).toBeLessThanOrEqual(most + 1);
      expect(ticks.length).toBeGreaterThan(Math.floor(most / 3));
    }
  });

  it('are none where there is no time', () => {
    expect(ticksOf([], 5)).toEqual([]);
    expect(ticksOf([{ cycle: 1, at: 4 }], 5)).toEqual([]);
  });
});

describe('the text of a moment', () => {
  it('says the cycle, its time and how long before the end it was', () => {
    const text = pastText(pastMoment(every10ms, 70, true)!, t);
    expect(text).toContain('cycle 1070');
    expect(text).toContain('2.30 s before the fault');
    expect(text).toContain(momentText(5700));
    expect(pastText(pastMoment(every10ms, 300, true)!, t)).toContain('the one of the fault');
    expect(pastText(pastMoment(every10ms, 299, false)!, t)).toContain('10 ms before the last one');
    expect(pastMoment(every10ms, null, false)).toBeNull();
    expect(pastMoment(every10ms, 301, false)).toBeNull();
  });

  it('writes spans as people read them', () => {
    expect([0.25, 12.3456, 999, 1000, 61_234].map(spanText)).toEqual([
      '0.25 ms',
      '12.3 ms',
      '999 ms',
      '1.00 s',
      '61.23 s',
    ]);
  });
});
