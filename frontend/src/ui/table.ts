/** Columns and selection of tables as data. Pure functions. */
import type { ReactNode } from 'react';

export interface Column<Item> {
  id: string;
  title: string;
  /** Pixels at the start; the column with `grow` takes what is left. */
  width: number;
  grow?: boolean;
  align?: 'right';
  cell: (item: Item) => ReactNode;
  /** Value to sort by; a column without it cannot be sorted. */
  sort?: (item: Item) => string | number;
  /** Full text on hover where the cell may be cut off. */
  hint?: (item: Item) => string;
}

export interface Sorting {
  column: string;
  descending: boolean;
}

/** Rows in the order asked for; equal ones keep their order. */
export function sorted<Item>(
  items: readonly Item[],
  columns: readonly Column<Item>[],
  sorting: Sorting | null,
): readonly Item[] {
  const value = sorting && columns.find((column) => column.id === sorting.column)?.sort;
  if (!value) return items;
  const factor = sorting.descending ? -1 : 1;
  return [...items].sort((a, b) => {
    const left = value(a);
    const right = value(b);
    if (typeof left === 'number' && typeof right === 'number') return factor * (left - right);
    return factor * String(left).localeCompare(String(right), undefined, { numeric: true });
  });
}

/** A click on a head: ascending, descending, then the natural order again. */
export function nextSorting(present: Sorting | null, column: string): Sorting | null {
  if (present?.column !== column) return { column, descending: false };
  return present.descending ? null : { column, descending: true };
}

/** Row that a key leads to, or null when the key means nothing here. */
export function rowAfterKey(key: string, row: number, rows: number, page: number): number | null {
  if (rows === 0) return null;
  const within = (index: number) => Math.max(0, Math.min(rows - 1, index));
  switch (key) {
    case 'ArrowDown':
      return within(row + 1);
    case 'ArrowUp':
      return within(row < 0 ? rows - 1 : row - 1);
    case 'PageDown':
      return within(row + page);
    case 'PageUp':
      return within(row - page);
    case 'Home':
      return 0;
    case 'End':
      return rows - 1;
    default:
      return null;
  }
}
