import { memo, type CSSProperties, type RefObject } from 'react';
import styles from '../Table.module.css';
import type { GridColumn, GridProps } from './gridProps';

/** Widths that the user has given to columns, in pixels. */
export type Widths = Readonly<Record<string, number>>;

/** What a click that has begun may become. */
export interface Press {
  /** The button went down on the cell that had the cursor already. */
  again: boolean;
  /** It went down on one of several chosen rows: they may be dragged, so it chooses only when it goes up. */
  pending: boolean;
}

export function widthOf(column: GridColumn, widths: Widths): CSSProperties {
  const width = widths[column.id] ?? column.width;
  const grows = column.grow === true && widths[column.id] === undefined;
  return grows
    ? { flex: `1 0 ${String(width)}px`, minWidth: width, width: 0 }
    : { flex: `0 0 ${String(width)}px`, width };
}

interface GridRowProps {
  /** What the grid is given; while it scrolls, that stays the same, and rows that stay are not drawn again. */
  grid: GridProps;
  id: string;
  row: number;
  /** Pixels from the top of the first row. */
  start: number;
  widths: Widths;
  press: RefObject<Press>;
}

/** One row of a grid. */
export const GridRow = memo(function GridRow({ grid, id, row, start, widths, press }: GridRowProps) {
  const { columns, cursor, editing = null, onCursor, onEdit } = grid;
  const canDrag = grid.onDragRow !== undefined && editing === null;
  return (
    <div
      role="row"
      aria-rowindex={row + 1}
      aria-selected={grid.selected.has(row)}
      aria-level={grid.level?.(row)}
      aria-expanded={grid.expanded?.(row)}
      className={styles.row}
      data-state={grid.rowState?.(row)}
      style={{ transform: `translateY(${String(start)}px)` }}
      draggable={canDrag}
      onDragStart={(event) => grid.onDragRow?.(row, event)}
    >
      {columns.map((column, at) => {
        const edited = editing?.row === row && editing.column === at;
        return (
          <div
            key={column.id}
            id={`${id}-${String(row)}-${String(at)}`}
            role="gridcell"
            className={`${styles.cell} ${column.align === 'right' ? styles.right : ''} ${column.code ? styles.code : ''}`}
            data-cursor={cursor?.row === row && cursor.column === at ? '' : undefined}
            data-editing={edited ? '' : undefined}
            style={widthOf(column, widths)}
            title={edited ? undefined : grid.hint?.(row, column)}
            onPointerDown={(event) => {
              if (edited || (event.button !== 0 && grid.selected.has(row))) return;
              press.current.pending = canDrag && !event.shiftKey && grid.selected.size > 1 && grid.selected.has(row);
              if (press.current.pending) return;
              const plain = event.button === 0 && !event.ctrlKey && !event.metaKey && !event.shiftKey;
              press.current.again = plain && cursor?.row === row && cursor.column === at;
              onCursor(
                { row, column: at },
                event.ctrlKey || event.metaKey ? 'toggle' : event.shiftKey ? 'range' : 'one',
              );
            }}
            onClick={(event) => {
              if (press.current.pending)
                onCursor({ row, column: at }, event.ctrlKey || event.metaKey ? 'toggle' : 'one');
              press.current.pending = false;
              if (grid.editOnClick === true && press.current.again && !edited) onEdit?.({ row, column: at });
              press.current.again = false;
              const plain = !event.ctrlKey && !event.metaKey && !event.shiftKey;
              // The second click of a double click is meant for the field that the first one has opened.
              if (plain && event.detail <= 1 && !edited && grid.opensOnClick?.(column) === true)
                onEdit?.({ row, column: at });
            }}
            onDoubleClick={() => !edited && grid.opensOnClick?.(column) !== true && onEdit?.({ row, column: at })}
          >
            {edited && editing ? grid.editor?.(editing) : grid.cell(row, column)}
          </div>
        );
      })}
    </div>
  );
});
