/** What the trees do with objects: create, rename, move, copy, delete. Shown at once, taken back when the server refuses. */
import { kindOf } from '@/project/kinds';
import { api } from '@/api/client';
import { keys, patchSummary, queryClient, summaryOf } from '@/api/queries';
import type { ObjectSummary, ProjectObject, Schemas } from '@/api/types';
import { closePanelsOf } from '../docking/dock';
import { applyChange, moved, renamed, without } from '@/project/changes';

type Objects = ObjectSummary[];

/** The change of each project that was asked for last. */
const newest = new Map<string, Promise<unknown>>();

/** Asks behind the changes before: the server has them in the order of the user, and undo means the one made last. */
function inTurn<Answer>(projectId: string, ask: () => Promise<Answer>): Promise<Answer> {
  const answer = (newest.get(projectId) ?? Promise.resolve()).then(ask);
  newest.set(
    projectId,
    answer.catch(() => undefined),
  );
  return answer;
}

/** Changes the tree on screen, then asks the server; when it refuses, the former tree is back and the error goes on. */
async function optimistic<Answer>(
  projectId: string,
  change: (objects: Objects) => Objects,
  ask: () => Promise<Answer>,
): Promise<Answer> {
  const key = keys.objects(projectId);
  const shown = queryClient.cancelQueries({ queryKey: key }).then(() => {
    queryClient.setQueryData<Objects>(key, (objects) => objects && change(objects));
  });
  try {
    return await inTurn(projectId, () => shown.then(ask));
  } catch (error) {
    // Others may have changed something in between: ask for the truth instead of putting the old list back.
    await queryClient.invalidateQueries({ queryKey: key });
    throw error;
  }
}

function put(projectId: string, change: 'created' | 'moved', object: ObjectSummary): void {
  queryClient.setQueryData<Objects>(
    keys.objects(projectId),
    (objects) => objects && applyChange(objects, { op: 'object', change, object: summaryOf(object), author: '' }),
  );
}

/** Creates an object; what the server creates below it is read as well. */
export async function createObject(projectId: string, order: Schemas['NewObject']): Promise<ProjectObject> {
  const created = await inTurn(projectId, () =>
    api.post('/api/v1/projects/{project_id}/objects', {
      params: { path: { project_id: projectId } },
      body: order,
    }),
  );
  put(projectId, 'created', created);
  if (kindOf(order.kind)?.add?.bringsChildren ?? true) {
    await queryClient.invalidateQueries({ queryKey: keys.objects(projectId) });
  }
  return created;
}

/** Renames or moves an object that nobody else has changed. */
function arrange(projectId: string, { id, revision }: ObjectSummary, change: Schemas['ObjectMove']) {
  return api.patch('/api/v1/projects/{project_id}/objects/{object_id}', {
    params: { path: { project_id: projectId, object_id: id } },
    body: { base_revision: revision, ...change },
  });
}

export async function renameObject(projectId: string, object: ObjectSummary, name: string): Promise<void> {
  const answer = await optimistic(
    projectId,
    (objects) => renamed(objects, object.id, name),
    () => arrange(projectId, object, { name }),
  );
  patchSummary(projectId, answer);
  // The declaration carries the name, too.
  await queryClient.invalidateQueries({ queryKey: keys.object(projectId, object.id) });
}

export async function moveObject(
  projectId: string,
  object: ObjectSummary,
  parentId: string | null,
  index: number,
): Promise<void> {
  const answer = await optimistic(
    projectId,
    (objects) => moved(objects, object.id, parentId, index),
    () => arrange(projectId, object, { parent_id: parentId, index }),
  );
  put(projectId, 'moved', answer);
}

export async function copyObject(projectId: string, objectId: string, parentId: string | null): Promise<ProjectObject> {
  const copy = await inTurn(projectId, () =>
    api.post('/api/v1/projects/{project_id}/objects/{object_id}/copy', {
      params: { path: { project_id: projectId, object_id: objectId } },
      body: { parent_id: parentId },
    }),
  );
  put(projectId, 'created', copy);
  await queryClient.invalidateQueries({ queryKey: keys.objects(projectId) });
  return copy;
}

/** Undoes the last change of the tree by this user, or does again what was undone last. */
export async function undoChange(projectId: string, way: 'undo' | 'redo') {
  const params = { path: { project_id: projectId } };
  const outcome = await inTurn(projectId, () =>
    way === 'undo'
      ? api.post('/api/v1/projects/{project_id}/undo', { params })
      : api.post('/api/v1/projects/{project_id}/redo', { params }),
  );
  await queryClient.invalidateQueries({ queryKey: keys.project(projectId) });
  const left = new Set((queryClient.getQueryData<Objects>(keys.objects(projectId)) ?? []).map(({ id }) => id));
  closePanelsOf(outcome.touched.filter((id) => !left.has(id)));
  return outcome;
}

/** Deletes objects with all that is below them and closes their editors. */
export async function deleteObjects(projectId: string, ids: readonly string[]): Promise<void> {
  const before = queryClient.getQueryData<Objects>(keys.objects(projectId)) ?? [];
  await optimistic(
    projectId,
    (objects) => without(objects, ids),
    () =>
      api.post('/api/v1/projects/{project_id}/objects/delete', {
        params: { path: { project_id: projectId } },
        body: { object_ids: [...ids] },
      }),
  );
  const left = new Set(without(before, ids).map((object) => object.id));
  closePanelsOf(before.filter((object) => !left.has(object.id)).map((object) => object.id));
}
