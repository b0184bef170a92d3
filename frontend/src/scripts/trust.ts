/**
 * Which scripts run without a question. Whoever may change a project may change its scripts, and a script acts with the
 * rights of whom it runs for: so each text is shown before its first run, unless nobody else has written at it.
 */
import { api } from '@/api/client';
import { loadNames, saveSetting } from '@/session/preferences';
import { useSession } from '@/session/session';

const KEY = 'scripts.trusted';
const MOST = 500;
/** How a text of one's own comes to be; what was imported, copied or merged may be anybody's. */
const OWN_ACTIONS: readonly string[] = ['add', 'save', 'rename', 'move', 'undo', 'redo'];

export interface TextRevision {
  author: string;
  action: string;
}

/** Whether a text was written by this user alone, by the history of its object. */
export function isOwn(revisions: readonly TextRevision[], username: string | undefined): boolean {
  return (
    revisions.length > 0 && revisions.every(({ author, action }) => author === username && OWN_ACTIONS.includes(action))
  );
}

/** The text as a number; null where the browser calculates none, on pages without HTTPS on other hosts. */
export async function hashOf(text: string): Promise<string | null> {
  if (!('subtle' in crypto)) return null;
  const digest = await crypto.subtle.digest('SHA-256', new TextEncoder().encode(text));
  return [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, '0')).join('');
}

/** Whether the user has run this very text before, or is the only one who has written at it. */
export async function isTrusted(projectId: string, objectId: string, text: string): Promise<boolean> {
  const hash = await hashOf(text);
  if (hash !== null && ((await loadNames(KEY)) ?? []).includes(hash)) return true;
  const revisions = await api.get('/api/v1/projects/{project_id}/objects/{object_id}/revisions', {
    params: { path: { project_id: projectId, object_id: objectId } },
  });
  return isOwn(revisions, useSession.getState().user?.username);
}

/** From now on the user runs this text without being asked. */
export async function trust(text: string): Promise<void> {
  const hash = await hashOf(text);
  if (hash === null) return;
  const known = (await loadNames(KEY)) ?? [];
  if (!known.includes(hash)) await saveSetting(KEY, [...known, hash].slice(-MOST));
}
