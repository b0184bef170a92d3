import { useOnline, type OnlineSession } from '../onlineSession';
import { useProject } from '@/project/openProject';

/** Login of the active application; undefined while logged out. */
export function useActiveSession(): OnlineSession | undefined {
  const applicationId = useProject((state) => state.applicationId);
  return useOnline((state) => (applicationId ? state.sessions[applicationId] : undefined));
}
