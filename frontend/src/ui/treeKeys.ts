import type { KeyboardEvent } from 'react';

interface TreeRow {
  expandable: boolean;
  expanded: boolean;
}

interface TreeActs<Row> {
  goTo: (index: number) => void;
  twist: (row: Row) => void;
  /** Space. */
  toggle: (row: Row) => void;
}

/** What the keys do in a tree of rows to choose from: arrows move, open and close, Space chooses. */
export function treeKey<Row extends TreeRow>(
  event: KeyboardEvent,
  rows: readonly Row[],
  at: number,
  { goTo, twist, toggle }: TreeActs<Row>,
): void {
  const row = rows[at];
  if (!row) return;
  const move = (index: number) => goTo(Math.max(0, Math.min(rows.length - 1, index)));
  if (event.key === 'ArrowDown') move(at + 1);
  else if (event.key === 'ArrowUp') move(at - 1);
  else if (event.key === 'Home') move(0);
  else if (event.key === 'End') move(rows.length - 1);
  else if (event.key === ' ') toggle(row);
  else if (event.key === 'ArrowRight' && row.expandable && !row.expanded) twist(row);
  else if (event.key === 'ArrowLeft' && row.expanded) twist(row);
  else return;
  event.preventDefault();
}
