/**
 * Which kind of object may be where, and how it may be named: the rules of `/placement`, applied as the server does,
 * so that menus offer and drags accept only what will work. The server has the last word. Pure functions.
 */
import type { ObjectSummary, PlacementRule } from '@/api/types';
import type { TextKey } from '@/i18n';
import { firstKind, hasRole, kindOf } from './kinds';
import { childrenOf, freeName, isWithin, type Forest, type TreeView } from './tree';

/** The nearest object at or above the parent that is no folder; undefined for the root of a view. */
export function ownerOf(forest: Forest, parentId: string | null): ObjectSummary | undefined {
  let at = parentId ? forest.byId.get(parentId) : undefined;
  while (at && hasRole(at, 'folder')) at = at.parent_id ? forest.byId.get(at.parent_id) : undefined;
  return at;
}

/** Objects directly below an owner and in its folders. */
function scopeOf(forest: Forest, ownerId: string | null): ObjectSummary[] {
  return childrenOf(forest, ownerId).flatMap((child) =>
    hasRole(child, 'folder') ? [child, ...scopeOf(forest, child.id)] : [child],
  );
}

/** Whether an object of the kind may be below the parent. `present` is there already and does not count as another. */
function mayPlace(
  rule: PlacementRule,
  forest: Forest,
  parentId: string | null,
  view: TreeView,
  present?: string,
): boolean {
  const owner = ownerOf(forest, parentId);
  const place = owner ? owner.kind : parentId === null && view === 'devices' ? 'devices_view' : 'pous_view';
  if (!rule.parents.includes(place)) return false;
  if (rule.parent_subkinds.length && owner?.subkind && !rule.parent_subkinds.includes(owner.subkind)) {
    return false;
  }
  const direct = parentId ? forest.byId.get(parentId) : undefined;
  if (!rule.in_folders && hasRole(direct, 'folder')) return false;
  if (rule.naming === 'fixed' && freeFixedNames(rule, forest, parentId, present).length === 0) return false;
  return (
    !rule.once || !scopeOf(forest, owner?.id ?? null).some((item) => item.kind === rule.kind && item.id !== present)
  );
}

/** Kinds that Add Object offers here, in the order of the rules, folders last. */
export function placeableKinds(
  rules: readonly PlacementRule[],
  forest: Forest,
  parentId: string | null,
  view: TreeView,
): PlacementRule[] {
  const kinds = rules.filter((rule) => mayPlace(rule, forest, parentId, view));
  // Folders fit nearly everywhere and are seldom what is wanted: they come last.
  return [...kinds.filter((rule) => !hasRole(rule, 'folder')), ...kinds.filter((rule) => hasRole(rule, 'folder'))];
}

function freeFixedNames(rule: PlacementRule, forest: Forest, parentId: string | null, present?: string): string[] {
  const taken = new Set(
    childrenOf(forest, parentId)
      .filter((child) => child.id !== present)
      .map((child) => child.name),
  );
  return rule.names.filter((name) => !taken.has(name));
}

/** Names to choose from where naming is fixed; empty where the user types one. */
export function fixedNames(rule: PlacementRule, forest: Forest, parentId: string | null): string[] {
  return rule.naming === 'fixed' ? freeFixedNames(rule, forest, parentId) : [];
}

/** The kind that the dialog begins with: the one asked for, else the one added most often. */
export function firstChoice(kinds: readonly PlacementRule[], asked?: string): PlacementRule {
  const of = (kind: string | undefined) => kinds.find((candidate) => candidate.kind === kind);
  return of(asked) ?? of(firstKind()?.kind) ?? kinds[0]!;
}

/** The name that the dialog proposes: PLC_PRG for the first POU of an application, otherwise the rule's, made unique. */
export function proposedName(rule: PlacementRule, forest: Forest, parentId: string | null): string {
  if (rule.naming === 'fixed') return freeFixedNames(rule, forest, parentId)[0] ?? rule.names[0] ?? '';
  const owner = ownerOf(forest, parentId);
  const scope = scopeOf(forest, owner?.id ?? null);
  const isFirst = hasRole(owner, 'application') && !scope.some((item) => item.kind === rule.kind);
  const firstName = isFirst ? kindOf(rule.kind)?.add?.firstName : undefined;
  return freeName(
    scope.map((item) => item.name),
    firstName ?? (rule.proposal || rule.kind),
  );
}

const IDENTIFIER = /^[A-Za-z_][A-Za-z0-9_]*$/;

/** What is wrong with a name, as the key of a text; null when it will do. `own` is the object that has the name. */
export function nameFault(
  rule: PlacementRule | undefined,
  forest: Forest,
  parentId: string | null,
  name: string,
  own?: string,
): { key: TextKey; values: { name: string } } | null {
  const fault = (key: TextKey) => ({ key, values: { name } });
  if (name === '') return fault('name.empty');
  if (rule?.naming === 'identifier') {
    if (!IDENTIFIER.test(name)) return fault('name.identifier');
    if (name.includes('__')) return fault('name.underscores');
  } else if (name !== name.trim()) return fault('name.blanks');
  else if (/[./\\]/.test(name)) return fault('name.separators');
  const isDevice = rule !== undefined && hasRole(rule, 'device');
  const owner = ownerOf(forest, parentId);
  const siblings =
    rule !== undefined && hasRole(rule, 'folder') ? childrenOf(forest, parentId) : scopeOf(forest, owner?.id ?? null);
  const taken = siblings.some(
    (item) =>
      item.id !== own &&
      item.name.toUpperCase() === name.toUpperCase() &&
      (item.parent_id === parentId || !hasRole(item, 'folder')) &&
      (parentId !== null || hasRole(item, 'device') === isDevice),
  );
  return taken ? fault('name.taken') : null;
}

export interface DropPlace {
  parentId: string | null;
  index: number;
}

/** Where a drag onto a row would go: into it, or before or after it among its siblings. */
export function dropPlace(forest: Forest, target: ObjectSummary, where: 'before' | 'inside' | 'after'): DropPlace {
  if (where === 'inside') return { parentId: target.id, index: childrenOf(forest, target.id).length };
  const siblings = childrenOf(forest, target.parent_id);
  const at = siblings.findIndex((sibling) => sibling.id === target.id);
  return { parentId: target.parent_id, index: where === 'before' ? at : at + 1 };
}

/** Whether all of these objects may be dropped there; nothing goes into itself. */
export function mayDrop(
  rules: readonly PlacementRule[],
  forest: Forest,
  ids: readonly string[],
  parentId: string | null,
  view: TreeView,
  copy = false,
): boolean {
  return ids.every((id) => {
    const object = forest.byId.get(id);
    const rule = object && rules.find((candidate) => candidate.kind === object.kind);
    if (!object || !rule) return false;
    if (parentId !== null && isWithin(forest, parentId, id)) return false;
    return mayPlace(rule, forest, parentId, view, copy ? undefined : id);
  });
}
