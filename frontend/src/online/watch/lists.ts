/**
 * Watch lists: Watch 1 to 4 and any number of own ones; kept for user and project, online and offline (WAT-01, WAT-10,
 * WAT-11).
 */
import { hasRole, type Role } from '@/project/kinds';
import { create } from 'zustand';
import { loadSetting } from '@/session/preferences';
import { saveSettingLater } from '@/session/settingsLater';
import type { ObjectSummary } from '@/api/types';
import type { NumberFormat } from '@/text/settings';
import {
  entriesFrom,
  FIXED_LISTS,
  listsFrom,
  PLAIN,
  toStored,
  type Listed,
  type ListOptions,
  type WatchEntry,
  type WatchList,
} from './model';

const EMPTY: readonly WatchList[] = FIXED_LISTS.map((id) => ({ id, name: null, entries: [], options: PLAIN }));
const SAVE_AFTER_MS = 800;

interface WatchState {
  projectId: string | null;
  lists: readonly WatchList[];
  /** List that "Add to watch" fills: the one used last. */
  current: string;
}

export const useWatchLists = create<WatchState>(() => ({ projectId: null, lists: EMPTY, current: '1' }));

let serial = 0;
const newId = () => `w${String((serial += 1))}-${String(Date.now())}`;

export function findList(id: string): WatchList | undefined {
  return useWatchLists.getState().lists.find((list) => list.id === id);
}

const keyOf = (projectId: string) => `watch.${projectId}`;
const identified = (listed: readonly Listed[]): readonly WatchEntry[] =>
  listed.map((entry) => ({ id: newId(), ...entry }));

let loading: Promise<void> = Promise.resolve();

/** Loads the lists of a project that is opened. */
export function loadLists(projectId: string): Promise<void> {
  if (useWatchLists.getState().projectId !== projectId) loading = load(projectId);
  return loading;
}

async function load(projectId: string): Promise<void> {
  useWatchLists.setState({ projectId, lists: EMPTY, current: '1' });
  const stored = await loadSetting(keyOf(projectId)).catch(() => null);
  const now = useWatchLists.getState();
  if (now.projectId !== projectId) return;
  // What was added while loading is not lost.
  const added = (id: string) => now.lists.find((list) => list.id === id)?.entries ?? [];
  const lists = listsFrom(stored).map(({ entries, ...list }) => ({
    ...list,
    entries: [...identified(entries), ...added(list.id)],
  }));
  useWatchLists.setState({ lists });
}

/** The project is closed: its lists go. */
export function forgetLists(): void {
  useWatchLists.setState({ projectId: null, lists: EMPTY, current: '1' });
}

function setLists(lists: readonly WatchList[]): void {
  useWatchLists.setState({ lists });
  const { projectId } = useWatchLists.getState();
  if (projectId === null) return;
  saveSettingLater(keyOf(projectId), () => toStored(lists), SAVE_AFTER_MS);
}

function update(id: string, changed: (list: WatchList) => Partial<WatchList>): void {
  setLists(useWatchLists.getState().lists.map((list) => (list.id === id ? { ...list, ...changed(list) } : list)));
}

function change(list: string, next: (entries: readonly WatchEntry[]) => readonly WatchEntry[]): void {
  update(list, ({ entries }) => ({ entries: next(entries) }));
}

/** Makes an own list, empty or with the lines of another one; returns its id. */
export function newList(name: string, from: string | null = null): string {
  const { lists } = useWatchLists.getState();
  const copied = lists.find((list) => list.id === from);
  let id = '';
  do id = `own${Date.now().toString(36)}${String((serial += 1))}`;
  while (lists.some((list) => list.id === id));
  const entries = (copied?.entries ?? []).map((entry) => ({ ...entry, id: newId() }));
  setLists([...lists, { id, name: name.trim(), entries, options: copied?.options ?? PLAIN }]);
  useWatchLists.setState({ current: id });
  return id;
}

export function renameList(id: string, name: string): void {
  update(id, (list) => (list.name === null ? {} : { name: name.trim() }));
}

/** Takes an own list away; Watch 1 to 4 stay. */
export function deleteList(id: string): void {
  const { lists, current } = useWatchLists.getState();
  setLists(lists.filter((list) => list.id !== id || list.name === null));
  if (current === id) useWatchLists.setState({ current: '1' });
}

/** Changes what a list shows. */
export function setListOptions(list: string, changes: Partial<ListOptions>): void {
  update(list, ({ options }) => ({ options: { ...options, ...changes } }));
}

/** Gives lines a number format of their own; undefined takes it away. */
export function setLineFormat(list: string, ids: readonly string[], format: NumberFormat | undefined): void {
  change(list, (entries) =>
    entries.map(({ format: old, ...entry }) => {
      const wanted = ids.includes(entry.id) ? format : old;
      return wanted === undefined ? entry : { ...entry, format: wanted };
    }),
  );
}

/** Adds expressions before `before` or at the end; one that is in the list already is not added twice. */
export function addToList(list: string, expressions: readonly string[], before: string | null = null): void {
  change(list, (entries) => {
    const known = new Set(entries.map((entry) => entry.expression.toUpperCase()));
    const fresh = identified(
      entriesFrom(expressions).filter(
        ({ expression }) => !known.has(expression.toUpperCase()) && known.add(expression.toUpperCase()),
      ),
    );
    const at = entries.findIndex((entry) => entry.id === before);
    return at < 0 ? [...entries, ...fresh] : [...entries.slice(0, at), ...fresh, ...entries.slice(at)];
  });
}

/** Changes an expression; an empty one removes the line. */
export function setExpression(list: string, id: string, expression: string): void {
  change(list, (entries) =>
    expression.trim() === ''
      ? entries.filter((entry) => entry.id !== id)
      : entries.map((entry) => (entry.id === id ? { ...entry, expression: expression.trim() } : entry)),
  );
}

export function removeFromList(list: string, ids: readonly string[]): void {
  const gone = new Set(ids);
  change(list, (entries) => entries.filter((entry) => !gone.has(entry.id)));
}

export function moveInList(list: string, id: string, direction: -1 | 1): void {
  change(list, (entries) => {
    const at = entries.findIndex((entry) => entry.id === id);
    const to = at + direction;
    if (at < 0 || to < 0 || to >= entries.length) return entries;
    const next = [...entries];
    [next[at], next[to]] = [next[to] as WatchEntry, next[at] as WatchEntry];
    return next;
  });
}

export function setCurrentList(current: string): void {
  if (useWatchLists.getState().current !== current) useWatchLists.setState({ current });
}

/**
 * The expression as the runtime knows it: `Device.Application.PLC_PRG.x` loses the device and application it is
 * asked of (WAT-03); a pasted `THIS^.x` or trailing semicolon is cleaned.
 */
export function plainExpression(expression: string, objects: readonly ObjectSummary[]): string {
  const text = expression
    .trim()
    .replace(/;$/, '')
    .replace(/\s*\.\s*/g, '.');
  const [first = '', second = '', ...rest] = text.split('.');
  const named = (role: Role, name: string) =>
    objects.some((o) => hasRole(o, role) && o.name.toUpperCase() === name.toUpperCase());
  if (rest.length > 0 && named('device', first) && named('application', second)) return rest.join('.');
  if (second !== '' && named('application', first)) return [second, ...rest].join('.');
  return text;
}
