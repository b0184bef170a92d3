/** Cursor and selection of editable tables. Pure functions. */
import { toggledIn } from '../toggleSet';

export interface GridCursor {
  readonly row: number;
  readonly column: number;
}

/** Cell that a key leads to, or null when the key moves nothing. */
export function cursorAfterKey(
  key: string,
  ctrl: boolean,
  cursor: GridCursor | null,
  rows: number,
  columns: number,
  page: number,
): GridCursor | null {
  if (rows === 0) return null;
  const at = cursor ?? { row: -1, column: 0 };
  const within = (row: number, column: number): GridCursor => ({
    row: Math.max(0, Math.min(rows - 1, row)),
    column: Math.max(0, Math.min(columns - 1, column)),
  });
  switch (key) {
    case 'ArrowDown':
      return ctrl ? within(rows - 1, at.column) : within(at.row + 1, at.column);
    case 'ArrowUp':
      return ctrl ? within(0, at.column) : within(at.row < 0 ? rows - 1 : at.row - 1, at.column);
    case 'ArrowRight':
      return within(at.row, at.column + 1);
    case 'ArrowLeft':
      return within(at.row, at.column - 1);
    case 'PageDown':
      return within(at.row + page, at.column);
    case 'PageUp':
      return within(at.row - page, at.column);
    case 'Home':
      return ctrl ? within(0, 0) : within(at.row, 0);
    case 'End':
      return ctrl ? within(rows - 1, columns - 1) : within(at.row, columns - 1);
    default:
      return null;
  }
}

/** Rows chosen after the cursor went to `row`: alone, added or taken away, or all from the anchor on. */
export function selectionAfter(
  before: ReadonlySet<number>,
  anchor: number | null,
  row: number,
  how: 'one' | 'toggle' | 'range',
): ReadonlySet<number> {
  if (how === 'one') return new Set([row]);
  if (how === 'toggle') return toggledIn(before, row);
  const from = anchor ?? row;
  const low = Math.min(from, row);
  return new Set(Array.from({ length: Math.abs(from - row) + 1 }, (_, i) => low + i));
}
