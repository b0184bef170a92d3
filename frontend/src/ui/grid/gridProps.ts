/** What a grid is given. */
import type { DragEvent, KeyboardEvent, ReactNode, Ref } from 'react';
import type { GridCursor } from './cursor';
import type { Layer } from './GridLayer';
import type { RowDrop } from './useRowDrop';

export interface GridColumn {
  id: string;
  title: string;
  /** Pixels at the start; a column with `grow` shares what is left. */
  width: number;
  grow?: boolean;
  align?: 'right';
  /** Text in the code font. */
  code?: boolean;
  sortable?: boolean;
}

export interface GridHandle {
  focus: () => void;
}

export interface GridEditing extends GridCursor {
  /** Text the editor starts with instead of the cell's own: the key that opened it. */
  initial?: string;
}

export interface GridProps {
  label: string;
  columns: readonly GridColumn[];
  count: number;
  keyOf: (row: number) => string;
  /** What a cell shows; rows are drawn again when the function is another one. */
  cell: (row: number, column: GridColumn) => ReactNode;
  hint?: (row: number, column: GridColumn) => string | undefined;
  /** Chosen rows; the cursor's row is among them. */
  selected: ReadonlySet<number>;
  cursor: GridCursor | null;
  onCursor: (cursor: GridCursor, how: 'one' | 'toggle' | 'range') => void;
  /** The cell being edited, and what edits it. */
  editing?: GridEditing | null;
  editor?: (editing: GridEditing) => ReactNode;
  /** A double click, F2, Enter, or typing on a cell; with `editOnClick` also a click on the cursor's cell. */
  onEdit?: (editing: GridEditing) => void;
  editOnClick?: boolean;
  /** Columns whose cells a single click edits at once. */
  opensOnClick?: (column: GridColumn) => boolean;
  /** First look at keys while no cell is edited; true when the key was used. */
  onKey?: (event: KeyboardEvent) => boolean;
  /** A click into the empty area behind the last row. */
  onEmptyClick?: () => void;
  sorting?: { column: string; descending: boolean } | null;
  onSort?: (column: string) => void;
  rowState?: (row: number) => string | undefined;
  level?: (row: number) => number;
  expanded?: (row: number) => boolean | undefined;
  /** Reports the rows on screen whenever they change. */
  onRange?: (first: number, last: number) => void;
  onDragRow?: (row: number, event: DragEvent) => void;
  onDropRow?: RowDrop;
  /** Drawn over the cells of a column. */
  layer?: Layer;
  empty?: ReactNode;
  ref?: Ref<GridHandle>;
}
