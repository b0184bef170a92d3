// @vitest-environment happy-dom
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import * as preferences from './preferences';
import { saveSettingLater, saveSettingNow, saveSettingsWhenThePageGoes } from './settingsLater';

let saved: [string, unknown, boolean | undefined][] = [];

beforeEach(() => {
  vi.useFakeTimers();
  saved = [];
  vi.spyOn(preferences, 'saveSetting').mockImplementation((key, value, keepalive) => {
    saved.push([key, value, keepalive]);
    return Promise.resolve();
  });
});

afterEach(() => {
  vi.useRealTimers();
  vi.restoreAllMocks();
});

it('stores the last of many changes once', () => {
  for (let n = 0; n < 5; n += 1) {
    saveSettingLater('layout', () => n, 100);
    vi.advanceTimersByTime(90);
  }
  expect(saved).toEqual([]);
  vi.advanceTimersByTime(10);
  expect(saved).toEqual([['layout', 4, false]]);
  vi.advanceTimersByTime(1000);
  expect(saved).toHaveLength(1);
});

it('stores at once what waits, and nothing that does not', () => {
  saveSettingNow('layout');
  saveSettingLater('layout', () => 'new', 100);
  saveSettingLater('tree', () => 'open', 100);
  saveSettingNow('layout');
  expect(saved).toEqual([['layout', 'new', false]]);
  vi.advanceTimersByTime(100);
  expect(saved.slice(1)).toEqual([['tree', 'open', false]]);
});

it('stores everything in requests that outlive the page when it goes', () => {
  saveSettingsWhenThePageGoes();
  saveSettingLater('layout', () => 'new', 100);
  saveSettingLater('tree', () => 'open', 100);
  dispatchEvent(new Event('pagehide'));
  expect(saved).toEqual([
    ['layout', 'new', true],
    ['tree', 'open', true],
  ]);
  vi.advanceTimersByTime(100);
  expect(saved).toHaveLength(2);
});
