/** What a watch list is, and how it is kept in the settings of the user: without the ids of lines. Pure functions. */
import { NUMBER_FORMATS, type NumberFormat } from '@/text/settings';

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

export interface WatchList {
  /** `1` to `4`, or the name that an own list has in the stored settings. */
  readonly id: string;
  /** Of an own list; Watch 1 to 4 have their number. */
  readonly name: string | null;
  readonly entries: readonly WatchEntry[];
  readonly options: ListOptions;
}

export const FIXED_LISTS = ['1', '2', '3', '4'] as const;
export const PLAIN: ListOptions = { format: null, history: false };

export interface Listed {
  readonly expression: string;
  readonly format?: NumberFormat;
}

type StoredEntry = string | Listed;

/** Lines and options by the id of the list, and which own lists there are, in order. */
export interface StoredLists {
  readonly [id: string]: unknown;
  readonly options: Readonly<Record<string, ListOptions>>;
  readonly own: readonly { readonly id: string; readonly name: string }[];
}

interface StoredList {
  readonly id: string;
  readonly name: string | null;
  readonly entries: readonly Listed[];
  readonly options: ListOptions;
}

export function toStored(lists: readonly WatchList[]): StoredLists {
  const lines = lists.map(({ id, entries }): [string, readonly StoredEntry[]] => [
    id,
    entries.map(({ expression, format }) => (format ? { expression, format } : expression)),
  ]);
  return {
    ...Object.fromEntries(lines),
    options: Object.fromEntries(lists.map(({ id, options }) => [id, options])),
    own: lists.flatMap(({ id, name }) => (name === null ? [] : [{ id, name }])),
  };
}

/** Watch 1 to 4 and the own lists of stored settings; what is none of them is passed over. */
export function listsFrom(stored: unknown): StoredList[] {
  const kept = record(stored);
  const options = record(kept.options);
  const own = array(kept.own).flatMap((one) => {
    const { id, name } = record(one);
    return typeof id === 'string' && typeof name === 'string' && id.startsWith('own') ? [{ id, name }] : [];
  });
  return [...FIXED_LISTS.map((id) => ({ id, name: null })), ...own].map(({ id, name }) => {
    const { format, history } = record(options[id]);
    return {
      id,
      name,
      entries: array(kept[id]).flatMap(entryFrom),
      options: { format: formatted(format).format ?? null, history: history === true },
    };
  });
}

/** Lines of text as entries; blank ones are none. */
export function entriesFrom(expressions: readonly string[]): Listed[] {
  return expressions.map((text) => ({ expression: text.trim() })).filter(({ expression }) => expression !== '');
}

function entryFrom(stored: unknown): Listed[] {
  const { expression, format } = typeof stored === 'string' ? { expression: stored } : record(stored);
  return typeof expression === 'string' ? [{ expression, ...formatted(format) }] : [];
}

const formatted = (format: unknown): { format?: NumberFormat } => {
  const known = NUMBER_FORMATS.find((one) => one === format);
  return known === undefined ? {} : { format: known };
};

const array = (value: unknown): readonly unknown[] => (Array.isArray(value) ? (value as unknown[]) : []);

const record = (value: unknown): Readonly<Record<string, unknown>> =>
  typeof value === 'object' && value !== null ? (value as Record<string, unknown>) : {};
