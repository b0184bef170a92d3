import { beforeEach, describe, expect, it } from 'vitest';
import type { RuntimeState } from '@/api/types';
import { connectionLost, loggedIn, onlineTone, runtimeStateReceived, useOnline } from './onlineSession';

const state = (connected: boolean): RuntimeState =>
  ({ id: 'local', connected, since: '2026-03-10T08:00:00Z', state: 'run', halted: [] as string[] }) as RuntimeState;
const session = () => useOnline.getState().sessions.app!;

beforeEach(() => {
  useOnline.setState({ sessions: {} });
  loggedIn('app', 'local', 'same');
});

describe('an online session', () => {
  it('is lost since the server lost the runtime, though the browser still has the server', () => {
    runtimeStateReceived('local', state(true));
    runtimeStateReceived('local', state(false));
    expect(session().lostSince).toBe(Date.parse('2026-03-10T08:00:00Z'));
    expect(onlineTone(session())).toBe('lost');
  });

  it('stays lost since the first moment, and is restored by the runtime itself', () => {
    connectionLost('local', 5);
    runtimeStateReceived('local', state(false));
    expect(session().lostSince).toBe(5);
    runtimeStateReceived('local', state(true));
    expect(session().lostSince).toBeNull();
    expect(onlineTone(session())).toBe('running');
  });
});
