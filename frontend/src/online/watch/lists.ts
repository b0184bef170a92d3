/** Watch lists 1 to 4: expressions per list, kept for user and project, online and offline (WAT-01, WAT-10, WAT-11). */
import { hasRole, type Role } from '@/project/kinds';
import { create } from 'zustand';
import { loadSetting } from '@/session/preferences';
import { saveSettingLater } from '@/session/settingsLater';
import type { ObjectSummary } from '@/api/types';
import { useProject } from '@/project/openProject';
import { NUMBER_FORMATS, type NumberFormat } from '@/text/settings';

export const WATCH_LISTS = [1, 2, 3, 4] as const;
export type WatchList = (typeof WATCH_LISTS)[number];

export interface WatchEntry {
  /** Stays the same while the expression is edited. */
  readonly id: string;
  readonly expression: string;
  /** Number format of the line; undefined: that of the list. */
  readonly format?: NumberFormat;
}

/** What a list shows, for all its lines. */
export interface ListOptions {
  /** Null: as in the editors. */
  readonly format: NumberFormat | null;
  /** The last minute of each value as a sparkline. */
  readonly history: boolean;
}

export const PLAIN: ListOptions = { format: null, history: false };

export type AllOptions = Readonly<Record<WatchList, ListOptions>>;

export type Lists = Readonly<Record<WatchList, readonly WatchEntry[]>>;

const EMPTY: Lists = { 1: [], 2: [], 3: [], 4: [] };
const ALL_PLAIN: AllOptions = { 1: PLAIN, 2: PLAIN, 3: PLAIN, 4: PLAIN };
const SAVE_AFTER_MS = 800;

interface WatchState {
  projectId: string | null;
  lists: Lists;
  options: AllOptions;
  /** List that "Add to watch" fills: the one shown last. */
  current: WatchList;
}

export const useWatchLists = create<WatchState>(() => ({
  projectId: null,
  lists: EMPTY,
  options: ALL_PLAIN,
  current: 1,
}));

let serial = 0;
const newId = () => `w${String((serial += 1))}-${String(Date.now())}`;

type StoredEntry = string | { readonly expression: string; readonly format: NumberFormat };

/** Stored form without the ids, which mean something in this page alone. */
type Stored = Partial<Record<WatchList, readonly StoredEntry[]>> & { readonly options?: AllOptions };

function fromStored(stored: unknown): Lists {
  const kept = new Map<string, unknown>(Object.entries(stored ?? {}));
  const list = (number: WatchList) => {
    const entries = kept.get(String(number));
    return (Array.isArray(entries) ? (entries as unknown[]) : []).flatMap((one): WatchEntry[] => {
      const { expression, format } = typeof one === 'string' ? { expression: one } : (one as Partial<WatchEntry>);
      return typeof expression === 'string' ? [{ id: newId(), expression, ...formatted(format) }] : [];
    });
  };
  return { 1: list(1), 2: list(2), 3: list(3), 4: list(4) };
}

const formatted = (format: unknown): { format?: NumberFormat } => {
  const known = NUMBER_FORMATS.find((one) => one === format);
  return known === undefined ? {} : { format: known };
};

function optionsFrom(stored: unknown): AllOptions {
  const kept = (stored as { options?: Partial<Record<WatchList, Partial<ListOptions>>> } | null)?.options ?? {};
  const of = (number: WatchList): ListOptions => ({
    format: formatted(kept[number]?.format).format ?? null,
    history: kept[number]?.history === true,
  });
  return { 1: of(1), 2: of(2), 3: of(3), 4: of(4) };
}

export function toStored(lists: Lists, options: AllOptions = ALL_PLAIN): Stored {
  const entries = WATCH_LISTS.map((number) => [
    number,
    lists[number].map(({ expression, format }) => (format ? { expression, format } : expression)),
  ]);
  return { ...(Object.fromEntries(entries) as Stored), options };
}

const keyOf = (projectId: string) => `watch.${projectId}`;

/** Loads the lists of each project that is opened. */
export function followProject(): void {
  let latest = 0;
  const load = async (projectId: string | null) => {
    if (projectId === useWatchLists.getState().projectId) return;
    useWatchLists.setState({ projectId, lists: EMPTY, options: ALL_PLAIN });
    const mine = (latest += 1);
    if (projectId === null) return;
    const stored = await loadSetting(keyOf(projectId)).catch(() => null);
    // What was added while loading is not lost.
    if (mine === latest)
      useWatchLists.setState((now) => ({ lists: joined(fromStored(stored), now.lists), options: optionsFrom(stored) }));
  };
  void load(useProject.getState().projectId);
  useProject.subscribe((state) => void load(state.projectId));
}

function joined(stored: Lists, added: Lists): Lists {
  return Object.fromEntries(WATCH_LISTS.map((n) => [n, [...stored[n], ...added[n]]])) as unknown as Lists;
}

function change(list: WatchList, update: (entries: readonly WatchEntry[]) => readonly WatchEntry[]): void {
  const { lists } = useWatchLists.getState();
  useWatchLists.setState({ lists: { ...lists, [list]: update(lists[list]) } });
  save();
}

function save(): void {
  const { lists, options, projectId } = useWatchLists.getState();
  if (projectId === null) return;
  saveSettingLater(keyOf(projectId), () => toStored(lists, options), SAVE_AFTER_MS);
}

/** Changes what a list shows. */
export function setListOptions(list: WatchList, changes: Partial<ListOptions>): void {
  const { options } = useWatchLists.getState();
  useWatchLists.setState({ options: { ...options, [list]: { ...options[list], ...changes } } });
  save();
}

/** Gives lines a number format of their own; undefined takes it away. */
export function setLineFormat(list: WatchList, ids: readonly string[], format: NumberFormat | undefined): void {
  change(list, (entries) =>
    entries.map(({ format: old, ...entry }) => {
      const wanted = ids.includes(entry.id) ? format : old;
      return wanted === undefined ? entry : { ...entry, format: wanted };
    }),
  );
}

/** Adds expressions before `before` or at the end; one that is in the list already is not added twice. */
export function addToList(list: WatchList, expressions: readonly string[], before: string | null = null): void {
  change(list, (entries) => {
    const known = new Set(entries.map((entry) => entry.expression.toUpperCase()));
    const fresh = expressions
      .map((expression) => expression.trim())
      .filter(
        (expression) =>
          expression !== '' && !known.has(expression.toUpperCase()) && known.add(expression.toUpperCase()),
      )
      .map((expression) => ({ id: newId(), expression }));
    const at = entries.findIndex((entry) => entry.id === before);
    return at < 0 ? [...entries, ...fresh] : [...entries.slice(0, at), ...fresh, ...entries.slice(at)];
  });
}

/** Changes an expression; an empty one removes the line. */
export function setExpression(list: WatchList, id: string, expression: string): void {
  change(list, (entries) =>
    expression.trim() === ''
      ? entries.filter((entry) => entry.id !== id)
      : entries.map((entry) => (entry.id === id ? { ...entry, expression: expression.trim() } : entry)),
  );
}

export function removeFromList(list: WatchList, ids: readonly string[]): void {
  change(list, (entries) => entries.filter((entry) => !ids.includes(entry.id)));
}

export function moveInList(list: WatchList, id: string, direction: -1 | 1): void {
  change(list, (entries) => {
    const at = entries.findIndex((entry) => entry.id === id);
    const to = at + direction;
    if (at < 0 || to < 0 || to >= entries.length) return entries;
    const next = [...entries];
    [next[at], next[to]] = [next[to] as WatchEntry, next[at] as WatchEntry];
    return next;
  });
}

export function setCurrentList(current: WatchList): void {
  useWatchLists.setState({ current });
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
