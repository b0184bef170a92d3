/** Where the variables of an object live at run time: which path leads to them, which have no value at rest. */
import type { ObjectSummary } from '@/api/types';
import { parseDeclaration } from '../declaration/parse';

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
  while (at !== undefined && at.kind !== 'pou') {
    const parent: string | null = at.parent_id;
    at = ['method', 'action', 'property', 'accessor', 'folder'].includes(at.kind)
      ? objects.find((o) => o.id === parent)
      : undefined;
  }
  return at;
}

export function monitorTarget(
  objects: readonly ObjectSummary[],
  object: ObjectSummary,
  instance: string | null,
  declaration: string,
): MonitorTarget {
  const pou = owningPou(objects, object);
  const temporary = stackNames(object, pou, declaration);
  if (object.kind === 'gvl' || object.kind === 'persistent')
    return { path: object.name, needsInstanceOf: null, temporary };
  if (pou?.subkind === 'program') return { path: instance ?? pou.name, needsInstanceOf: null, temporary };
  if (pou?.subkind === 'function_block') {
    return { path: instance, needsInstanceOf: instance === null ? pou.name : null, temporary };
  }
  return { path: null, needsInstanceOf: null, temporary };
}

function stackNames(object: ObjectSummary, pou: ObjectSummary | undefined, declaration: string): ReadonlySet<string> {
  const model = parseDeclaration(declaration);
  const routine = ['method', 'accessor', 'property'].includes(object.kind) || pou?.subkind === 'function';
  const names = new Set<string>();
  for (const row of model.rows) {
    const scope = model.blocks[row.block]?.scope ?? '';
    if (routine ? !KEPT.has(scope) : STACK_SCOPES.has(scope)) names.add(row.name.text.toUpperCase());
  }
  // The result of a function or method carries its name.
  if (routine) names.add(object.name.toUpperCase());
  return names;
}
