import { keys, queryClient, useObjects } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { useOnline, type OnlineSession } from '@/workbench/onlineSession';
import { useProject } from '@/project/openProject';
import { applicationOf } from '@/project/tree';

/**
 * The online session that shows an object's values: of the application it belongs to, or of the active one for
 * objects of the POUs view. Null while logged out.
 */
export function objectSession(projectId: string, objectId: string): OnlineSession | null {
  const objects = queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId)) ?? [];
  const own = applicationOf(objects, objectId)?.id ?? useProject.getState().applicationId;
  return own === null ? null : (useOnline.getState().sessions[own] ?? null);
}

/** As `objectSession`, followed while it changes. */
export function useObjectSession(projectId: string | null, object: ObjectSummary | undefined): OnlineSession | null {
  const { data: objects } = useObjects(projectId);
  const active = useProject((state) => state.applicationId);
  const own = object && objects ? (applicationOf(objects, object.id)?.id ?? active) : active;
  return useOnline((state) => (own === null ? null : (state.sessions[own] ?? null)));
}
