/** Where the variables of an object live at run time: which path leads to them, which have no value at rest. */
import { hasRole, kindOf, valuesOf } from '@/project/kinds';
import type { ObjectSummary } from '@/api/types';
import { parseDeclaration } from '@/iec/declaration/parse';

export interface MonitorTarget {
  /** Path of the data shown: a program, an instance, a variable list; null when none is chosen or there is none. */
  readonly path: string | null;
  /** Function block whose instance has to be chosen; null where the path is fixed. */
  readonly needsInstanceOf: string | null;
  /** Upper-case names of variables on the stack. */
  readonly temporary: ReadonlySet<string>;
}

const STACK_SCOPES = new Set(['VAR_TEMP']);
/** In methods and functions only these keep their place between calls. */
const KEPT = new Set(['VAR_STAT', 'VAR_INST']);

/** The POU an object belongs to: itself, or the owner of a method, action, property or accessor. */
export function owningPou(objects: readonly ObjectSummary[], object: ObjectSummary): ObjectSummary | undefined {
  let at: ObjectSummary | undefined = object;
  while (at !== undefined && kindOf(at.kind)?.catalog !== 'pous') {
    const parent: string | null = belongsToParent(at) ? at.parent_id : null;
    at = objects.find(({ id }) => id === parent);
  }
  return at;
}

function belongsToParent(object: ObjectSummary): boolean {
  const place = valuesOf(object);
  return place === 'call' || place === 'owner' || hasRole(object, 'folder');
}

export function monitorTarget(
  objects: readonly ObjectSummary[],
  object: ObjectSummary,
  instance: string | null,
  declaration: string,
): MonitorTarget {
  const pou = owningPou(objects, object);
  const temporary = stackNames(object, pou, declaration);
  const place = valuesOf(pou ?? object);
  if (place === 'global') return { path: object.name, needsInstanceOf: null, temporary };
  if (pou && place === 'program') return { path: instance ?? pou.name, needsInstanceOf: null, temporary };
  if (pou && place === 'instance') {
    return { path: instance, needsInstanceOf: instance === null ? pou.name : null, temporary };
  }
  return { path: null, needsInstanceOf: null, temporary };
}

function stackNames(object: ObjectSummary, pou: ObjectSummary | undefined, declaration: string): ReadonlySet<string> {
  const model = parseDeclaration(declaration);
  const routine = valuesOf(object) === 'call' || (pou !== undefined && valuesOf(pou) === 'call');
  const names = new Set<string>();
  for (const row of model.rows) {
    const scope = model.blocks[row.block]?.scope ?? '';
    if (routine ? !KEPT.has(scope) : STACK_SCOPES.has(scope)) names.add(row.name.text.toUpperCase());
  }
  // The result of a function or method carries its name.
  if (routine) names.add(object.name.toUpperCase());
  return names;
}
