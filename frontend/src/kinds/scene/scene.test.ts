import { describe, expect, it } from 'vitest';
import type { OnlineSession } from '@/workbench/onlineSession';
import { runtimeOf } from './model';

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
