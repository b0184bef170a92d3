import { describe, expect, it } from 'vitest';
import type { OnlineSession } from '@/workbench/onlineSession';
import { pastCycleOf, runtimeOf } from './model';

const session = (runtimeId: string): OnlineSession => ({
  applicationId: 'a',
  runtimeId,
  relation: 'same',
  runtime: null,
  lostSince: null,
  pacedMs: null,
  past: null,
});

describe('runtime of a scene', () => {
  it('is the one logged in to', () => expect(runtimeOf([session('press 3')])).toBe('press 3'));
  it('is the own one of the server while logged out', () => expect(runtimeOf([])).toBe('local'));
});

describe('past cycle of a scene', () => {
  const past = { cycle: 12, at: 0, before: 30, fault: false };
  it('is the one that its runtime shows', () => expect(pastCycleOf([{ ...session('press 3'), past }])).toBe(12));
  it('is none at the present and while logged out', () => {
    expect(pastCycleOf([session('press 3'), { ...session('press 4'), past }])).toBeNull();
    expect(pastCycleOf([])).toBeNull();
  });
});
