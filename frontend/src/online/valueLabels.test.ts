// @vitest-environment happy-dom
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { LABEL_MS, labelValue, unlabelValue } from './valueLabels';

const cell = () => document.createElement('span');
const nameOf = (element: Element) => element.getAttribute('aria-label');

describe('names of painted values', () => {
  beforeEach(() => vi.useFakeTimers());
  afterEach(() => {
    vi.runAllTimers();
    vi.useRealTimers();
  });

  it('are the value at once where it has stood still', () => {
    const shown = cell();
    labelValue(shown, '1');
    expect(nameOf(shown)).toBe('1');
    vi.advanceTimersByTime(2 * LABEL_MS);
    labelValue(shown, '2');
    expect(nameOf(shown)).toBe('2');
  });

  it('change once a second while the value goes on changing, and end with the last one', () => {
    const [shown, other] = [cell(), cell()];
    const names: (string | null)[] = [];
    for (let change = 0; change < 30; change += 1) {
      labelValue(shown, String(change));
      labelValue(other, String(-change));
      if (names.at(-1) !== nameOf(shown)) names.push(nameOf(shown));
      vi.advanceTimersByTime(LABEL_MS / 10);
    }
    expect(names).toEqual(['0', '9', '19']);
    expect(vi.getTimerCount()).toBe(1);
    vi.advanceTimersByTime(LABEL_MS);
    expect([nameOf(shown), nameOf(other)]).toEqual(['29', '-29']);
    expect(shown.textContent).toBe('29');
    vi.advanceTimersByTime(2 * LABEL_MS);
    expect(vi.getTimerCount()).toBe(0);
  });

  it('go with the value: what waits names nothing any more', () => {
    const shown = cell();
    labelValue(shown, '1');
    labelValue(shown, '2');
    unlabelValue(shown);
    vi.advanceTimersByTime(2 * LABEL_MS);
    expect([nameOf(shown), shown.textContent]).toEqual([null, '']);
    labelValue(shown, '3');
    expect(nameOf(shown)).toBe('3');
  });
});
