/** Keeps the relation of a login true while the project changes: nothing to load, online change, or download. */
import { api } from '@/api/client';
import type { LoginAnswer } from '@/api/types';
import { relationChanged, useOnline, type OnlineSession } from '../onlineSession';
import { useProject } from '@/project/openProject';

/** Saving comes in bursts; only the last of them is compared. */
export const QUIET_MS = 800;

export type Compare = (session: OnlineSession) => Promise<LoginAnswer>;

/** Asks the server how the stored application relates to the one in the runtime; nothing is loaded. */
export function compareLogin(projectId: string, applicationId: string, runtimeId: string): Promise<LoginAnswer> {
  return api.post('/api/v1/projects/{project_id}/applications/{application_id}/login', {
    params: { path: { project_id: projectId, application_id: applicationId } },
    body: { runtime_id: runtimeId },
  });
}

export interface RelationFollower {
  /** An object of the project was saved, made, moved or deleted. */
  projectChanged: () => void;
  close: () => void;
}

export function followRelation(compare: Compare): RelationFollower {
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
  };
  return {
    projectChanged: () => {
      if (Object.keys(useOnline.getState().sessions).length > 0) later();
    },
    close: () => {
      closed = true;
      clearTimeout(timer);
    },
  };
}
