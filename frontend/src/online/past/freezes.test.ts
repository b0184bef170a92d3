import { afterEach, expect, it, vi } from 'vitest';
import { api } from '@/api/client';
import { renewFreezes, useTimeBars, type TimeBarState } from './store';

const bar = (frozen: boolean): TimeBarState => ({
  moments: [],
  at: null,
  fault: false,
  parts: 1,
  frozen,
  playing: null,
});

afterEach(() => {
  vi.restoreAllMocks();
  useTimeBars.setState({ bars: {} });
});

it('renews what this page has frozen, and nothing else', () => {
  const post = vi.spyOn(api, 'post').mockResolvedValue(undefined);
  useTimeBars.setState({ bars: { press: bar(true), oven: bar(false) } });
  renewFreezes();
  renewFreezes();
  const owner: unknown = expect.stringMatching(/^page-\w+$/);
  const order = { params: { path: { runtime_id: 'press' } }, body: { owner, lease_s: 180 } };
  const path = '/api/v1/runtimes/{runtime_id}/flight/renew';
  expect(post.mock.calls).toEqual([
    [path, order],
    [path, order],
  ]);
});

it('goes on without a word when the freeze is gone', async () => {
  vi.spyOn(api, 'post').mockRejectedValue(new Error('not frozen any more'));
  useTimeBars.setState({ bars: { press: bar(true) } });
  expect(() => renewFreezes()).not.toThrow();
  await Promise.resolve();
});
