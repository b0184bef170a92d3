// @vitest-environment happy-dom
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { FRESH_MS, markFresh, unmarkFresh } from './freshMarks';

describe('marks of changed values', () => {
  beforeEach(() => vi.useFakeTimers({ now: 5000 }));
  afterEach(() => vi.useRealTimers());

  it('fade a second after the last change, each at its time, by one timer', () => {
    const [a, b] = [document.createElement('span'), document.createElement('span')];
    vi.advanceTimersByTime(100);
    markFresh(a, performance.now());
    vi.advanceTimersByTime(500);
    markFresh(b, performance.now());
    expect(vi.getTimerCount()).toBe(1);
    expect([a.dataset.fresh, b.dataset.fresh]).toEqual(['true', 'true']);
    vi.advanceTimersByTime(600);
    expect([a.dataset.fresh, b.dataset.fresh]).toEqual([undefined, 'true']);
    vi.advanceTimersByTime(FRESH_MS);
    expect(b.dataset.fresh).toBeUndefined();
    expect(vi.getTimerCount()).toBe(0);
  });

  it('stand on no value that is seen for the first time, and go when taken off', () => {
    const element = document.createElement('span');
    markFresh(element, 0);
    expect(element.dataset.fresh).toBeUndefined();
    vi.advanceTimersByTime(100);
    markFresh(element, performance.now());
    unmarkFresh(element);
    expect(element.dataset.fresh).toBeUndefined();
  });
});
