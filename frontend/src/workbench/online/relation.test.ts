import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { LoginAnswer } from '@/api/types';
import { loggedIn, useOnline } from '../onlineSession';
import { useProject } from '@/project/openProject';
import { followRelation, QUIET_MS } from './relation';

const answer = (relation: LoginAnswer['relation']) => ({ relation, reasons: [] }) as unknown as LoginAnswer;
const relation = () => useOnline.getState().sessions.app?.relation;

beforeEach(() => {
  vi.useFakeTimers();
  useOnline.setState({ sessions: {} });
  useProject.setState({ busy: null });
});
afterEach(() => void vi.useRealTimers());

describe('relation of a login', () => {
  it('is asked once after a burst of saves', async () => {
    loggedIn('app', 'local', 'same');
    const compare = vi.fn(() => Promise.resolve(answer('online_change')));
    const follower = followRelation(compare);
    follower.projectChanged();
    follower.projectChanged();
    await vi.advanceTimersByTimeAsync(QUIET_MS);
    expect(compare).toHaveBeenCalledTimes(1);
    expect(relation()).toBe('online_change');
  });

  it('is not asked while nobody is logged in', async () => {
    const compare = vi.fn(() => Promise.resolve(answer('download')));
    followRelation(compare).projectChanged();
    await vi.advanceTimersByTimeAsync(QUIET_MS);
    expect(compare).not.toHaveBeenCalled();
  });

  it('waits for a build that is under way', async () => {
    loggedIn('app', 'local', 'same');
    useProject.setState({ busy: { text: 'Build', cancel: () => undefined } });
    const follower = followRelation(() => Promise.resolve(answer('download')));
    follower.projectChanged();
    await vi.advanceTimersByTimeAsync(QUIET_MS);
    expect(relation()).toBe('same');
    useProject.setState({ busy: null });
    await vi.advanceTimersByTimeAsync(QUIET_MS);
    expect(relation()).toBe('download');
  });

  it('stays as it was while the text does not build, and after the project was left', async () => {
    loggedIn('app', 'local', 'same');
    const broken = followRelation(() => Promise.reject(new Error('errors')));
    broken.projectChanged();
    await vi.advanceTimersByTimeAsync(QUIET_MS);
    expect(relation()).toBe('same');
    const left = followRelation(() => Promise.resolve(answer('download')));
    left.projectChanged();
    left.close();
    await vi.advanceTimersByTimeAsync(QUIET_MS);
    expect(relation()).toBe('same');
  });
});
