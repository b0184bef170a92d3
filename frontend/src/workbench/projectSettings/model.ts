/** What was changed in the project settings, beside what is stored. Pure functions. */
import type { ObjectContent } from '@/api/queries';
import type { ProjectObject } from '@/api/types';

/** The new data of objects, by id. */
export type Changes = Readonly<Record<string, ProjectObject['data']>>;

/** The objects as the dialog shows them. */
export function withChanges(objects: readonly ProjectObject[], changes: Changes): ProjectObject[] {
  return objects.map((object) => ({ ...object, data: changes[object.id] ?? object.data }));
}

/** What is to be saved, on top of the revisions that were shown. */
export function changedObjects(objects: readonly ProjectObject[], changes: Changes): ObjectContent[] {
  return objects.flatMap((object) => {
    const data = changes[object.id];
    if (data === undefined || JSON.stringify(data) === JSON.stringify(object.data)) return [];
    return [{ object_id: object.id, base_revision: object.revision, data }];
  });
}
