/**
 * Keeps the relation of the application to what its controller runs true while the project changes: nothing to load,
 * online change, or download. Before a login it is asked for the active application, behind everything else.
 */
import { api } from '@/api/client';
import type { LoginAnswer } from '@/api/types';
import { relationChanged, useOnline } from '../onlineSession';
import { useProject } from '@/project/openProject';
import { relationKnown, relationUnknown } from './knownRelation';

/** Saving comes in bursts; only the last of them is compared. */
export const QUIET_MS = 800;

/** An application and a controller that may run it. */
export interface Compared {
  applicationId: string;
  runtimeId: string;
}
export type Compare = (compared: Compared) => Promise<LoginAnswer>;
/** The active application with the controller that a login would go to; null where that is not known. */
export type Offline = () => Promise<Compared | null>;

/** Asks the server how the stored application relates to the one in the runtime; nothing is loaded. */
export async function compareLogin(projectId: string, applicationId: string, runtimeId: string): Promise<LoginAnswer> {
  const answer = await api.post('/api/v1/projects/{project_id}/applications/{application_id}/login', {
    params: { path: { project_id: projectId, application_id: applicationId } },
    body: { runtime_id: runtimeId },
  });
  relationKnown(applicationId, runtimeId, answer);
  return answer;
}

export interface RelationFollower {
  /** An object of the project was saved, made, moved or deleted. */
  projectChanged: () => void;
  close: () => void;
}

export function followRelation(compare: Compare, offline: Offline = () => Promise.resolve(null)): RelationFollower {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let closed = false;
  let asked = 0;
  const later = () => {
    clearTimeout(timer);
    timer = setTimeout(() => void ask(), QUIET_MS);
  };
  const ask = async () => {
    // A build or download under way ends with a comparison of its own, but of an older text.
    if (useProject.getState().busy !== null) {
      later();
      return;
    }
    const turn = ++asked;
    const sessions = Object.values(useOnline.getState().sessions).filter((session) => session.lostSince === null);
    for (const session of sessions) {
      try {
        const { relation } = await compare(session);
        if (!closed && turn === asked) relationChanged(session.applicationId, relation);
      } catch {
        // Text that does not build has no relation; the messages say what is wrong with it.
      }
    }
    const target = await offline().catch(() => null);
    if (target === null || closed || turn !== asked) return;
    await compare(target).catch(() => relationUnknown(target.applicationId));
  };
  const unsubscribe = useProject.subscribe((state, before) => {
    if (state.applicationId !== before.applicationId && state.applicationId !== null) later();
  });
  if (useProject.getState().applicationId !== null) later();
  return {
    projectChanged: later,
    close: () => {
      closed = true;
      unsubscribe();
      clearTimeout(timer);
    },
  };
}
