/** What the trees mark beside names: messages of the compiler and forced variables. Pure functions. */
import type { Diagnostic, ObjectSummary, Severity } from '@/api/types';
import { holdsValues } from '@/project/kinds';
import { applicationOf } from '@/project/tree';

export interface Mark {
  severity?: Exclude<Severity, 'info'>;
  forced?: boolean;
}

/** The worst message of each object; information is not marked. */
function worst(messages: readonly Diagnostic[]): Map<string, 'error' | 'warning'> {
  const found = new Map<string, 'error' | 'warning'>();
  for (const { object_id: id, severity } of messages) {
    if (id === null || severity === 'info' || found.get(id) === 'error') continue;
    found.set(id, severity);
  }
  return found;
}

/**
 * Marks by object id. `forces` holds the forced paths (`GVL.x`, `PLC_PRG.fb1.y`) of each application that is logged in:
 * the program or variable list that a path begins with is marked.
 */
export function marksOf(
  objects: readonly ObjectSummary[],
  messages: readonly Diagnostic[],
  forces: ReadonlyMap<string, readonly string[]>,
): ReadonlyMap<string, Mark> {
  const marks = new Map<string, Mark>();
  for (const [id, severity] of worst(messages)) marks.set(id, { severity });
  if ([...forces.values()].every((paths) => paths.length === 0)) return marks;
  const roots = new Map([...forces].map(([application, paths]) => [application, new Set(paths.map(rootOf))]));
  for (const object of objects) {
    if (!holdsValues(object)) continue;
    const application = applicationOf(objects, object.id)?.id;
    const name = object.name.toUpperCase();
    const forced = application
      ? roots.get(application)?.has(name)
      : [...roots.values()].some((names) => names.has(name));
    if (forced) marks.set(object.id, { ...marks.get(object.id), forced: true });
  }
  return marks;
}

function rootOf(path: string): string {
  return (path.split(/[.[]/)[0] ?? '').toUpperCase();
}
