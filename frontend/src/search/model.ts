/** Search and replace as data: what is asked, the rows of the results, what shall be replaced. Pure functions. */
import type { ObjectSummary, Schemas } from '@/api/types';

export type Area = Schemas['Area'];
export type SearchHit = Schemas['SearchHit'];
export type SearchObject = Schemas['SearchObject'];
type SearchOrder = Schemas['SearchOrder'];
type ReplaceOrder = Schemas['ReplaceOrder'];

export const AREAS: readonly Area[] = ['declarations', 'implementations', 'comments', 'names', 'tables'];
export const SCOPES = ['project', 'active', 'selection', 'editors', 'libraries'] as const;
export type Scope = (typeof SCOPES)[number];

export interface SearchForm {
  text: string;
  replacement: string;
  /** The field for what replaces the hits is shown, and what it would make of them. */
  replacing: boolean;
  matchCase: boolean;
  wholeWords: boolean;
  regularExpression: boolean;
  areas: readonly Area[];
  scope: Scope;
}

/** What a scope depends on. */
export interface ScopeObjects {
  applicationId: string | null;
  selection: readonly string[];
  editors: readonly string[];
}

const LIMIT = 2000;

/** The request for a form; null while it asks for nothing. */
export function orderOf(form: SearchForm, objects: ScopeObjects, after: string | null): SearchOrder | null {
  if (form.text === '' || form.areas.length === 0) return null;
  const within = withinOf(form.scope, objects);
  if (within?.length === 0) return null;
  return {
    ...queryOf(form),
    within,
    children: form.scope !== 'editors',
    libraries: form.scope === 'libraries',
    replacement: form.replacing && form.scope !== 'libraries' ? form.replacement : null,
    after,
    limit: LIMIT,
  };
}

function queryOf(form: SearchForm) {
  return {
    text: form.text,
    match_case: form.matchCase,
    whole_words: form.wholeWords,
    regular_expression: form.regularExpression,
    areas: [...form.areas],
  };
}

/** The objects of a scope; null is the whole project. */
export function withinOf(scope: Scope, { applicationId, selection, editors }: ScopeObjects): string[] | null {
  switch (scope) {
    case 'project':
    case 'libraries':
      return null;
    case 'active':
      return applicationId === null ? [] : [applicationId];
    case 'selection':
      return [...selection];
    case 'editors':
      return [...editors];
  }
}

/** Two parts of one search, the second of which goes on behind the first. */
export function joined(before: readonly SearchObject[], more: readonly SearchObject[]): readonly SearchObject[] {
  return [...before, ...more];
}

export function keyOf(object: SearchObject): string {
  return object.object_id ?? object.path;
}

export function hitKey(object: SearchObject, hit: SearchHit): string {
  return `${keyOf(object)}#${String(hit.number)}`;
}

/** A row of the results; its shape is that of the rows that keys move in. */
export interface ResultRow {
  object: { id: string };
  level: 1 | 2;
  expandable: boolean;
  expanded: boolean;
  group: SearchObject;
  hit: SearchHit | null;
}

export function rowsOf(groups: readonly SearchObject[], closed: ReadonlySet<string>): ResultRow[] {
  return groups.flatMap((group): ResultRow[] => {
    const id = keyOf(group);
    const expanded = !closed.has(id);
    const head: ResultRow = { object: { id }, level: 1, expandable: true, expanded, group, hit: null };
    if (!expanded) return [head];
    return [
      head,
      ...group.hits.map((hit): ResultRow => {
        return { object: { id: hitKey(group, hit) }, level: 2, expandable: false, expanded: false, group, hit };
      }),
    ];
  });
}

/** Hits that can be replaced and are not left out. */
export function chosenHits(group: SearchObject, leftOut: ReadonlySet<string>): SearchHit[] {
  return group.hits.filter((hit) => hit.writable && !leftOut.has(hitKey(group, hit)));
}

/** Whether all, some or none of the hits of an object will be replaced; null where none can be. */
export function choiceOf(group: SearchObject, leftOut: ReadonlySet<string>): boolean | 'some' | null {
  const possible = group.hits.filter((hit) => hit.writable).length;
  const chosen = chosenHits(group, leftOut).length;
  if (possible === 0) return null;
  return chosen === possible ? true : chosen === 0 ? false : 'some';
}

/** The set of hits left out, after the box of a hit or of a whole object was clicked. */
export function withChoice(row: ResultRow, leftOut: ReadonlySet<string>): ReadonlySet<string> {
  const next = new Set(leftOut);
  const hits = row.hit === null ? row.group.hits : [row.hit];
  const allIn = hits.every((hit) => !hit.writable || !leftOut.has(hitKey(row.group, hit)));
  for (const hit of hits) {
    if (allIn) next.add(hitKey(row.group, hit));
    else next.delete(hitKey(row.group, hit));
  }
  return next;
}

/** The request that replaces what is chosen; null when nothing is. */
export function replaceOrderOf(
  form: SearchForm,
  groups: readonly SearchObject[],
  leftOut: ReadonlySet<string>,
): ReplaceOrder | null {
  const objects = groups.flatMap((group) => {
    const hits = chosenHits(group, leftOut).map((hit) => hit.number);
    return group.object_id === null || hits.length === 0
      ? []
      : [{ object_id: group.object_id, base_revision: group.revision, hits }];
  });
  return objects.length === 0 ? null : { query: queryOf(form), replacement: form.replacement, objects };
}

export function hitCount(groups: readonly SearchObject[]): number {
  return groups.reduce((sum, group) => sum + group.total, 0);
}

/** Objects that are not as they were when they were searched. */
export function changedSince(groups: readonly SearchObject[], objects: readonly ObjectSummary[]): boolean {
  const revisions = new Map(objects.map((object) => [object.id, object.revision]));
  return groups.some((group) => group.object_id !== null && revisions.get(group.object_id) !== group.revision);
}

/** Which field an error of the server belongs to; null where it belongs to none. */
export function fieldOfProblem(type: string | undefined): 'text' | 'replacement' | null {
  if (type === 'urn:tappet:problem:invalid-pattern') return 'text';
  return type === 'urn:tappet:problem:invalid-replacement' ? 'replacement' : null;
}
