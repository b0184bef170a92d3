import { keys, objectQuery, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { onlineTone, type OnlineSession, type OnlineTone } from './onlineSession';
import { useProject } from '@/project/openProject';
import { ofRole } from '@/project/kinds';
import { deviceOf } from '@/project/tree';

/** Whether the device that carries an application is set to simulation, as far as it has been read. */
export function isSimulated(applicationId: string): boolean {
  const { projectId } = useProject.getState();
  if (!projectId) return false;
  const objects = queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId)) ?? [];
  const device = deviceOf(objects, applicationId);
  const stored = device && queryClient.getQueryData(objectQuery(projectId, device.id).queryKey);
  return stored !== undefined && ofRole('device')(stored) && stored.data.simulated;
}

/** How an application looks online; undefined while it is logged out. */
export function toneOfApplication(
  applicationId: string,
  sessions: Readonly<Record<string, OnlineSession>>,
): OnlineTone | undefined {
  const session = sessions[applicationId];
  return session && onlineTone(session, isSimulated(applicationId));
}
