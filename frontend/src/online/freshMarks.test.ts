import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { FRESH_MS, markFresh, unmarkFresh } from './freshMarks';

/** Something that shows a value, and what it has been told. */
function shown() {
  const told: boolean[] = [];
  return { told, setFresh: (fresh: boolean) => void told.push(fresh) };
}

describe('marks of changed values', () => {
  beforeEach(() => vi.useFakeTimers({ now: 5000 }));
  afterEach(() => vi.useRealTimers());

  it('fade a second after the last change, each at its time, by one timer', () => {
    const [a, b] = [shown(), shown()];
    vi.advanceTimersByTime(100);
    markFresh(a, performance.now());
    vi.advanceTimersByTime(500);
    markFresh(b, performance.now());
    expect(vi.getTimerCount()).toBe(1);
    expect([a.told, b.told]).toEqual([[true], [true]]);
    vi.advanceTimersByTime(600);
    expect([a.told, b.told]).toEqual([[true, false], [true]]);
    vi.advanceTimersByTime(FRESH_MS);
    expect(b.told).toEqual([true, false]);
    expect(vi.getTimerCount()).toBe(0);
  });

  it('are set once while a value goes on changing', () => {
    const a = shown();
    vi.advanceTimersByTime(100);
    for (let change = 0; change < 20; change += 1) {
      markFresh(a, performance.now());
      vi.advanceTimersByTime(100);
    }
    expect(a.told).toEqual([true]);
    vi.advanceTimersByTime(2 * FRESH_MS);
    expect(a.told).toEqual([true, false]);
  });

  it('stand on no value that is seen for the first time, and go when taken off', () => {
    const a = shown();
    markFresh(a, 0);
    expect(a.told).toEqual([]);
    vi.advanceTimersByTime(100);
    markFresh(a, performance.now());
    unmarkFresh(a);
    expect(a.told).toEqual([true, false]);
  });
});
