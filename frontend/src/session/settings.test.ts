import { beforeEach, expect, it, vi } from 'vitest';
import { settingsOf } from './settings';

const stored = new Map<string, unknown>();
vi.mock('./preferences', () => ({
  loadSetting: (key: string) => Promise.resolve(stored.get(key) ?? null),
  saveSetting: (key: string, value: unknown) => Promise.resolve(stored.set(key, value)),
}));
const DEFAULTS = { view: 'table', columns: 3, wide: false };

beforeEach(() => {
  vi.useFakeTimers();
  stored.clear();
});

it('keeps what was changed before the stored ones came, and stores the others as they were', async () => {
  stored.set('table', { view: 'text', columns: 5 });
  const settings = settingsOf('table', DEFAULTS);
  settings.change({ columns: 7 });
  expect(settings.use.getState()).toEqual({ view: 'table', columns: 7, wide: false });
  await vi.runAllTimersAsync();
  expect(settings.use.getState()).toEqual({ view: 'text', columns: 7, wide: false });
  expect(stored.get('table')).toEqual({ view: 'text', columns: 7, wide: false });
});

it('leaves out what has another type than its default', async () => {
  stored.set('table', { view: 4, columns: 5, tall: true });
  const settings = settingsOf('table', DEFAULTS);
  await settings.load();
  expect(settings.use.getState()).toEqual({ view: 'table', columns: 5, wide: false });
});
