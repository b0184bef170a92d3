import { api } from '@/api/client';
import { keys, patchSummary, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';

/** Leaves objects out of the build, or takes them in again. */
export async function excludeObjects(
  projectId: string,
  objects: readonly ObjectSummary[],
  excluded: boolean,
): Promise<void> {
  for (const { id } of objects) {
    const changed = await api.patch('/api/v1/projects/{project_id}/objects/{object_id}', {
      params: { path: { project_id: projectId, object_id: id } },
      body: { excluded },
    });
    queryClient.setQueryData(keys.object(projectId, id), changed);
    patchSummary(projectId, changed);
  }
}
