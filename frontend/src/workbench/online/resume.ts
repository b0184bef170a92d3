/** A reloaded page takes up the logins it had: the tab remembers them, the project's end forgets them. */
import { api } from '@/api/client';
import type { LoginRelation } from '@/api/types';
import { loggedIn, runtimePolled, useOnline } from '../onlineSession';
import { compareLogin } from './relation';

/** The part of `sessionStorage` that is needed: it lives as long as the tab. */
export type TabStore = Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>;

export interface Resumption {
  /** Stops remembering, and forgets: the project was left. */
  close: () => void;
}

const keyOf = (projectId: string) => `tappet.online.${projectId}`;

/** Runtime by application, as the tab remembers them; what is not of that form counts as nothing. */
export function rememberedLogins(store: TabStore, projectId: string): Record<string, string> {
  try {
    const stored: unknown = JSON.parse(store.getItem(keyOf(projectId)) ?? '{}');
    if (typeof stored !== 'object' || stored === null) return {};
    return Object.fromEntries(Object.entries(stored).filter(([, runtimeId]) => typeof runtimeId === 'string'));
  } catch {
    return {};
  }
}

/**
 * Logs in again, without building or asking, wherever the runtime is connected and holds something; from then on the
 * logins of the project are remembered. A text that does not build is shown as one that needs a download.
 */
export function resumeLogins(projectId: string, store: TabStore = sessionStorage): Resumption {
  let closed = false;
  const resume = async (applicationId: string, runtimeId: string) => {
    const runtime = await api.get('/api/v1/runtimes/{runtime_id}', { params: { path: { runtime_id: runtimeId } } });
    if (!runtime.connected || runtime.state === 'empty') return;
    const relation = await compareLogin(projectId, applicationId, runtimeId).then(
      (answer) => answer.relation,
      (): LoginRelation => 'download',
    );
    if (closed || relation === 'foreign' || relation === 'empty') return;
    loggedIn(applicationId, runtimeId, relation);
    runtimePolled(runtimeId, runtime);
  };
  const logins = Object.entries(rememberedLogins(store, projectId));
  let following = () => {};
  void Promise.allSettled(logins.map(([applicationId, runtimeId]) => resume(applicationId, runtimeId))).then(() => {
    if (!closed) following = follow(projectId, store);
  });
  return {
    close: () => {
      closed = true;
      following();
    },
  };
}

function follow(projectId: string, store: TabStore): () => void {
  const remember = () => {
    const sessions = Object.values(useOnline.getState().sessions);
    const logins = Object.fromEntries(sessions.map((session) => [session.applicationId, session.runtimeId]));
    store.setItem(keyOf(projectId), JSON.stringify(logins));
  };
  remember();
  const unsubscribe = useOnline.subscribe(remember);
  return () => {
    unsubscribe();
    store.removeItem(keyOf(projectId));
  };
}
