import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { api } from '@/api/client';
import type { LoginAnswer, RuntimeState } from '@/api/types';
import { loggedIn, loggedOut, useOnline } from '../onlineSession';
import { rememberedLogins, resumeLogins, type TabStore } from './resume';

function tab(content: Record<string, string> = {}): TabStore {
  const kept = new Map(Object.entries(content));
  return {
    getItem: (key) => kept.get(key) ?? null,
    setItem: (key, value) => void kept.set(key, value),
    removeItem: (key) => void kept.delete(key),
  };
}

const runtime = (values: Partial<RuntimeState>): RuntimeState =>
  ({ id: 'local', connected: true, state: 'run', since: null, ...values }) as RuntimeState;
const held = { 'tappet.online.p': '{"app":"local"}' };
const settled = () => new Promise((resolve) => setTimeout(resolve));

function server(state: RuntimeState, relation: LoginAnswer['relation'] | Error): void {
  vi.spyOn(api, 'get').mockResolvedValue(state as never);
  const post = vi.spyOn(api, 'post');
  if (relation instanceof Error) post.mockRejectedValue(relation);
  else post.mockResolvedValue({ relation, reasons: [] } as never);
}

beforeEach(() => useOnline.setState({ sessions: {} }));
afterEach(() => void vi.restoreAllMocks());

describe('logins after the page was reloaded', () => {
  it('come back with the relation of the server', async () => {
    server(runtime({}), 'online_change');
    resumeLogins('p', tab(held));
    await settled();
    expect(useOnline.getState().sessions.app).toMatchObject({ runtimeId: 'local', relation: 'online_change' });
    expect(useOnline.getState().sessions.app?.runtime?.state).toBe('run');
  });

  it('come back although the text does not build now', async () => {
    server(runtime({}), new Error('E0201'));
    resumeLogins('p', tab(held));
    await settled();
    expect(useOnline.getState().sessions.app?.relation).toBe('download');
  });

  it.each([
    ['is not reached', runtime({ connected: false }), 'same'],
    ['holds nothing', runtime({ state: 'empty' }), 'same'],
    ['holds another application', runtime({}), 'foreign'],
  ] as const)('stay away when the runtime %s', async (_why, state, relation) => {
    server(state, relation);
    const store = tab(held);
    resumeLogins('p', store);
    await settled();
    expect(useOnline.getState().sessions).toEqual({});
    expect(rememberedLogins(store, 'p')).toEqual({});
  });

  it('follow login and logout, and are forgotten with the project', async () => {
    const store = tab();
    const resumption = resumeLogins('p', store);
    await settled();
    loggedIn('app', 'local', 'same');
    expect(rememberedLogins(store, 'p')).toEqual({ app: 'local' });
    loggedOut('app');
    expect(rememberedLogins(store, 'p')).toEqual({});
    loggedIn('app', 'local', 'same');
    resumption.close();
    expect(rememberedLogins(store, 'p')).toEqual({});
  });

  it.each(['', 'null', '[]', '{"app":3}', '{'])('are none where the tab holds %j', (text) => {
    expect(rememberedLogins(tab({ 'tappet.online.p': text }), 'p')).toEqual({});
  });
});
