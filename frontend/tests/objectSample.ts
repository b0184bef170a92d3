import type { ObjectSummary } from '@/api/types';

/** An object of a project, for tests: its name is its id in capitals. */
export function objectSample(id: string, kind: string, parent_id: string | null, index = 0): ObjectSummary {
  return { id, kind, parent_id, name: id.toUpperCase(), subkind: null, index, revision: 1, excluded: false };
}
