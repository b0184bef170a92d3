/** Changes of the tree as functions on the list of summaries: events of others, and our own before the server answers. */
import type { ObjectSummary } from '@/api/types';
import { hasRole } from './kinds';

export interface ObjectEvent {
  op: 'object';
  change: 'created' | 'updated' | 'deleted' | 'moved';
  object: ObjectSummary;
  author: string;
}

/** The list after an event. Events that are older than what is known, or known already, change nothing. */
export function applyChange(objects: readonly ObjectSummary[], event: ObjectEvent): ObjectSummary[] {
  const known = objects.find((object) => object.id === event.object.id);
  switch (event.change) {
    case 'deleted':
      return without(objects, [event.object.id]);
    case 'created':
      return known ? replaced(objects, event.object) : placed([...objects, event.object], event.object);
    case 'updated':
      if (!known) return placed([...objects, event.object], event.object);
      return event.object.revision < known.revision ? [...objects] : replaced(objects, event.object);
    case 'moved':
      return placed(known ? replaced(objects, event.object) : [...objects, event.object], event.object);
  }
}

function replaced(objects: readonly ObjectSummary[], changed: ObjectSummary): ObjectSummary[] {
  return objects.map((object) => (object.id === changed.id ? changed : object));
}

/** Takes objects and all that is below them away. */
export function without(objects: readonly ObjectSummary[], ids: readonly string[]): ObjectSummary[] {
  const gone = new Set(ids);
  // Parents may come after their children in the list: repeat until nothing more goes.
  for (let before = -1; before !== gone.size;) {
    before = gone.size;
    for (const object of objects) if (object.parent_id !== null && gone.has(object.parent_id)) gone.add(object.id);
  }
  return objects.filter((object) => !gone.has(object.id));
}

/** Whether two objects are counted together; the roots of the Devices and the POUs view are not. */
function areSiblings(one: ObjectSummary, other: ObjectSummary): boolean {
  if (one.parent_id !== other.parent_id || one.id === other.id) return false;
  return one.parent_id !== null || hasRole(one, 'device') === hasRole(other, 'device');
}

/** Numbers the siblings of a placed object again, without gaps, the object itself at its index. */
function placed(objects: readonly ObjectSummary[], object: ObjectSummary): ObjectSummary[] {
  const siblings = objects.filter((other) => areSiblings(object, other)).sort((a, b) => a.index - b.index);
  siblings.splice(Math.min(object.index, siblings.length), 0, object);
  const index = new Map(siblings.map((sibling, at) => [sibling.id, at]));
  return objects.map((other) => {
    const at = index.get(other.id);
    return at === undefined || at === other.index ? other : { ...other, index: at };
  });
}

/** Our own move, shown before the server has answered. */
export function moved(
  objects: readonly ObjectSummary[],
  id: string,
  parentId: string | null,
  index: number,
): ObjectSummary[] {
  const object = objects.find((other) => other.id === id);
  if (!object) return [...objects];
  const there = { ...object, parent_id: parentId, index };
  return placed(replaced(objects, there), there);
}

/** Our own renaming, shown before the server has answered. */
export function renamed(objects: readonly ObjectSummary[], id: string, name: string): ObjectSummary[] {
  return objects.map((object) => (object.id === id ? { ...object, name } : object));
}
