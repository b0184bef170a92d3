/** The object tree as data: rows to draw, moving through them, where something may be dropped. Pure functions. */
import type { ObjectSummary } from '@/api/types';
import { hasRole, kindOf, type Role } from './kinds';

export interface Forest {
  byId: ReadonlyMap<string, ObjectSummary>;
  /** Children in their order; key '' holds the objects without a parent. */
  children: ReadonlyMap<string, readonly ObjectSummary[]>;
}

const NOTHING: readonly ObjectSummary[] = [];

export function forestOf(objects: readonly ObjectSummary[]): Forest {
  const byId = new Map(objects.map((object) => [object.id, object]));
  const children = new Map<string, ObjectSummary[]>();
  for (const object of objects) {
    const parent = object.parent_id ?? '';
    const list = children.get(parent);
    if (list) list.push(object);
    else children.set(parent, [object]);
  }
  for (const list of children.values()) list.sort((a, b) => a.index - b.index || a.name.localeCompare(b.name));
  return { byId, children };
}

export function childrenOf(forest: Forest, id: string | null): readonly ObjectSummary[] {
  return forest.children.get(id ?? '') ?? NOTHING;
}

/** The Devices view holds devices, the POUs view everything else that has no parent. */
export type TreeView = 'devices' | 'pous';

export function rootsOf(forest: Forest, view: TreeView): readonly ObjectSummary[] {
  return childrenOf(forest, null).filter((object) => hasRole(object, 'device') === (view === 'devices'));
}

/** Parents from the object itself up to its root. */
export function lineage(objects: readonly ObjectSummary[] | Forest, id: string | null): ObjectSummary[] {
  const byId = 'byId' in objects ? objects.byId : new Map(objects.map((object) => [object.id, object]));
  const line: ObjectSummary[] = [];
  for (
    let at = id ? byId.get(id) : undefined;
    at && line.length < 100;
    at = at.parent_id ? byId.get(at.parent_id) : undefined
  ) {
    line.push(at);
  }
  return line;
}

function nearest(objects: readonly ObjectSummary[] | Forest, id: string | null, role: Role): ObjectSummary | undefined {
  return lineage(objects, id).find((object) => hasRole(object, role));
}

/** The application that an object is, or belongs to. */
export function applicationOf(
  objects: readonly ObjectSummary[] | Forest,
  id: string | null,
): ObjectSummary | undefined {
  return nearest(objects, id, 'application');
}

/** The device that an object is, or belongs to. */
export function deviceOf(objects: readonly ObjectSummary[] | Forest, id: string | null): ObjectSummary | undefined {
  return nearest(objects, id, 'device');
}

/** The path as an engineer writes it: `Device.Application.PLC_PRG.Start`. */
export function objectPath(objects: readonly ObjectSummary[] | Forest, id: string): string {
  return lineage(objects, id)
    .filter((object) => !kindOf(object.kind)?.tree?.outsidePaths)
    .map((object) => object.name)
    .reverse()
    .join('.');
}

/** All names from the root to the object, as the server names the place of a message. */
export function treePath(objects: readonly ObjectSummary[] | Forest, id: string): string {
  return lineage(objects, id)
    .map((object) => object.name)
    .reverse()
    .join('/');
}

/** The object and everything below it. */
export function subtree(forest: Forest, id: string): ObjectSummary[] {
  const root = forest.byId.get(id);
  if (!root) return [];
  return [root, ...childrenOf(forest, id).flatMap((child) => subtree(forest, child.id))];
}

export function isWithin(forest: Forest, id: string, ancestor: string): boolean {
  return lineage(forest, id).some((object) => object.id === ancestor);
}

/** Of several selected objects those that lie below no other selected one: deleting or moving those does all. */
export function topMost(forest: Forest, ids: readonly string[]): string[] {
  return ids.filter((id) => !ids.some((other) => other !== id && isWithin(forest, id, other)));
}

export interface Row {
  object: ObjectSummary;
  /** 1 for roots, as `aria-level` counts. */
  level: number;
  expandable: boolean;
  expanded: boolean;
  position: number;
  siblings: number;
}

/** The rows on screen, top to bottom. With a filter, matching objects and their parents only, all open. */
export function rowsOf(
  forest: Forest,
  roots: readonly ObjectSummary[],
  expanded: ReadonlySet<string>,
  filter = '',
): Row[] {
  const wanted = filter.trim().toLowerCase();
  const kept = wanted ? keptByFilter(forest, wanted) : null;
  const rows: Row[] = [];
  const add = (objects: readonly ObjectSummary[], level: number) => {
    const shown = kept ? objects.filter((object) => kept.has(object.id)) : objects;
    shown.forEach((object, at) => {
      const below = childrenOf(forest, object.id);
      const expandable = below.length > 0;
      const open = expandable && (kept !== null || expanded.has(object.id));
      rows.push({ object, level, expandable, expanded: open, position: at + 1, siblings: shown.length });
      if (open) add(below, level + 1);
    });
  };
  add(roots, 1);
  return rows;
}

function keptByFilter(forest: Forest, wanted: string): Set<string> {
  const kept = new Set<string>();
  for (const object of forest.byId.values()) {
    if (!object.name.toLowerCase().includes(wanted)) continue;
    for (const ancestor of lineage(forest, object.id)) kept.add(ancestor.id);
  }
  return kept;
}

/** Ids to open so that the object is seen. */
export function opensFor(forest: Forest, id: string): string[] {
  return lineage(forest, id)
    .slice(1)
    .map((object) => object.id);
}

export type Motion = 'up' | 'down' | 'left' | 'right' | 'home' | 'end' | 'pageUp' | 'pageDown';

/** Keys that move the focus in every tree. */
export const MOTION_OF_KEY: Readonly<Record<string, Motion>> = {
  ArrowUp: 'up',
  ArrowDown: 'down',
  ArrowLeft: 'left',
  ArrowRight: 'right',
  Home: 'home',
  End: 'end',
};

export interface Move {
  /** Row that gets the focus. */
  focus?: string;
  open?: string;
  close?: string;
}

/** What keys that move the focus need to know of a row. */
export type FocusRow = Pick<Row, 'level' | 'expandable' | 'expanded'> & { object: { id: string } };

/** What an arrow key does, as the ARIA tree pattern says: right opens or goes in, left closes or goes out. */
export function moveFocus(rows: readonly FocusRow[], focused: string | null, motion: Motion, page = 10): Move {
  if (rows.length === 0) return {};
  const at = rows.findIndex((row) => row.object.id === focused);
  const row = rows[at];
  const to = (index: number): Move => ({ focus: rows[Math.max(0, Math.min(rows.length - 1, index))]!.object.id });
  if (!row) return to(motion === 'end' || motion === 'up' ? rows.length - 1 : 0);
  switch (motion) {
    case 'up':
      return to(at - 1);
    case 'down':
      return to(at + 1);
    case 'home':
      return to(0);
    case 'end':
      return to(rows.length - 1);
    case 'pageUp':
      return to(at - page);
    case 'pageDown':
      return to(at + page);
    case 'right':
      if (!row.expandable) return {};
      return row.expanded ? to(at + 1) : { open: row.object.id };
    case 'left': {
      if (row.expanded) return { close: row.object.id };
      for (let up = at - 1; up >= 0; up--) if (rows[up]!.level < row.level) return to(up);
      return {};
    }
  }
}

/** The next row whose name starts with what was typed; a repeated single letter walks through its matches. */
export function findTyped(rows: readonly Row[], focused: string | null, typed: string): string | null {
  const text = typed.toLowerCase();
  const repeated = text.length > 1 && [...text].every((letter) => letter === text[0]);
  const wanted = repeated ? text[0]! : text;
  const at = rows.findIndex((row) => row.object.id === focused);
  // While more letters narrow the search, the present row may stay; a fresh or repeated letter goes on to the next one.
  const first = text.length > 1 && !repeated ? Math.max(at, 0) : at + 1;
  for (let step = 0; step < rows.length; step++) {
    const row = rows[(first + step) % rows.length]!;
    if (row.object.name.toLowerCase().startsWith(wanted)) return row.object.id;
  }
  return null;
}

/** All rows from the anchor to the focused one: Shift+arrows and Shift+click. */
export function rangeOf(rows: readonly Row[], anchor: string | null, focused: string): string[] {
  const from = rows.findIndex((row) => row.object.id === anchor);
  const to = rows.findIndex((row) => row.object.id === focused);
  if (from < 0 || to < 0) return [focused];
  return rows.slice(Math.min(from, to), Math.max(from, to) + 1).map((row) => row.object.id);
}

/** A name that no sibling has: `POU`, `POU_1`, `POU_2` ... IEC names are not case sensitive. */
export function freeName(taken: readonly string[], wanted: string): string {
  const names = new Set(taken.map((name) => name.toUpperCase()));
  if (!names.has(wanted.toUpperCase())) return wanted;
  const stem = wanted.replace(/_\d+$/, '');
  for (let number = 1; ; number++) if (!names.has(`${stem}_${number}`.toUpperCase())) return `${stem}_${number}`;
}
