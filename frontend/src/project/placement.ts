/**
 * Which kind of object may be where, and how it may be named: what the server's table (`/placement`) says of a place, so
 * that menus offer and drags accept at once only what will work. The server has the last word. Pure functions.
 */
import type { ObjectSummary, PlacementRule } from '@/api/types';
import type { TextKey } from '@/i18n';
import { RESERVED } from '@/iec/grammar';
import { firstKind, hasRole } from './kinds';
import { childrenOf, freeName, isWithin, rootsOf, type Forest, type TreeView } from './tree';

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

/** The names under which the table lists a place. */
function placesOf(forest: Forest, parentId: string | null, view: TreeView): string[] {
  const owner = ownerOf(forest, parentId);
  const parent = owner?.kind ?? (parentId === null && view === 'devices' ? 'devices_view' : 'pous_view');
  const ending = hasRole(forest.byId.get(parentId ?? ''), 'folder') ? '/' : '';
  return [owner?.subkind ?? '', '*'].map((subkind) => `${parent}.${subkind}${ending}`);
}

/** Whether one more of the kind has room. `present` is there already and does not count. */
function hasRoom(rule: PlacementRule, forest: Forest, parentId: string | null, present?: string): boolean {
  if (rule.naming === 'fixed' && freeFixedNames(rule, forest, parentId, present).length === 0) return false;
  const scope = rule.once ? scopeOf(forest, ownerOf(forest, parentId)?.id ?? null) : [];
  return !scope.some((item) => item.kind === rule.kind && item.id !== present);
}

function mayPlace(rule: PlacementRule, forest: Forest, parentId: string | null, view: TreeView, present?: string) {
  const listed = placesOf(forest, parentId, view).some((place) => rule.places.includes(place));
  return listed && hasRoom(rule, forest, parentId, present);
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

/** The name that the dialog proposes, made unique; the first of its kind in an application may have its own. */
export function proposedName(rule: PlacementRule, forest: Forest, parentId: string | null): string {
  if (rule.naming === 'fixed') return freeFixedNames(rule, forest, parentId)[0] ?? rule.names[0] ?? '';
  const owner = ownerOf(forest, parentId);
  const scope = scopeOf(forest, owner?.id ?? null);
  const isFirst = owner !== undefined && !scope.some((item) => item.kind === rule.kind);
  return freeName(
    scope.map((item) => item.name),
    (isFirst && rule.first) || rule.proposal || rule.kind,
  );
}

const IDENTIFIER = /^[A-Za-z_][A-Za-z0-9_]*$/;
const WORDS: ReadonlySet<string> = new Set(RESERVED);

/** What is wrong with a name, as the key of a text; null when it will do. `own` is the object that has the name. */
export function nameFault(
  rules: readonly PlacementRule[],
  kind: string,
  forest: Forest,
  parentId: string | null,
  name: string,
  own?: string,
): { key: TextKey; values: { name: string } } | null {
  const ruleOf = (one: string) => rules.find((rule) => rule.kind === one);
  const fault = (key: TextKey) => ({ key, values: { name } });
  if (name === '') return fault('name.empty');
  if (ruleOf(kind)?.naming === 'identifier') {
    if (!IDENTIFIER.test(name)) return fault('name.identifier');
    if (name.includes('__')) return fault('name.underscores');
    if (WORDS.has(name.toUpperCase())) return fault('name.reserved');
  } else if (name !== name.trim()) return fault('name.blanks');
  else if (/[./\\]/.test(name)) return fault('name.separators');
  const inCode = (one: string) => ruleOf(one)?.unique !== 'place';
  const siblings =
    parentId === null
      ? rootsOf(forest, hasRole({ kind }, 'device') ? 'devices' : 'pous')
      : childrenOf(forest, parentId);
  const scope = inCode(kind) ? scopeOf(forest, ownerOf(forest, parentId)?.id ?? null) : [];
  const others = [...siblings, ...scope.filter((item) => inCode(item.kind))];
  const taken = others.some((item) => item.id !== own && item.name.toUpperCase() === name.toUpperCase());
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
