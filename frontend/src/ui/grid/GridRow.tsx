import { memo, type CSSProperties, type RefObject } from 'react';
import styles from '../Table.module.css';
import type { GridColumn, GridEditing, GridProps } from './gridProps';

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

type Drawn = Pick<GridProps, 'columns' | 'cell' | 'hint' | 'level' | 'expanded' | 'rowState'>;

interface GridRowProps extends Drawn {
  /** What the grid is given now: events ask it, so that another function draws no row again. */
  grid: RefObject<GridProps>;
  id: string;
  row: number;
  /** Pixels from the top of the first row. */
  start: number;
  widths: Widths;
  press: RefObject<Press>;
  selected: boolean;
  /** Number of the column of the cursor; -1 in rows that it does not stand in. */
  cursorAt: number;
  /** The cell of this row that is being edited. */
  editing: GridEditing | null;
  editor: GridProps['editor'];
  canDrag: boolean;
}

/** One row of a grid. It is drawn again when what it shows changes, not with each drawing of the grid. */
export const GridRow = memo(function GridRow(props: GridRowProps) {
  const { columns, cell, hint, grid, id, row, widths, press, cursorAt, editing, canDrag } = props;
  return (
    <div
      role="row"
      aria-rowindex={row + 1}
      aria-selected={props.selected}
      aria-level={props.level?.(row)}
      aria-expanded={props.expanded?.(row)}
      className={styles.row}
      data-state={props.rowState?.(row)}
      style={{ top: props.start }}
      draggable={canDrag}
      onDragStart={(event) => grid.current.onDragRow?.(row, event)}
    >
      {columns.map((column, at) => {
        const edited = editing?.column === at;
        return (
          <div
            key={column.id}
            id={`${id}-${String(row)}-${String(at)}`}
            role="gridcell"
            className={`${styles.cell} ${column.align === 'right' ? styles.right : ''} ${column.code ? styles.code : ''}`}
            data-cursor={cursorAt === at ? '' : undefined}
            data-editing={edited ? '' : undefined}
            style={widthOf(column, widths)}
            title={edited ? undefined : hint?.(row, column)}
            onPointerDown={(event) => {
              const { selected, onCursor } = grid.current;
              if (edited || (event.button !== 0 && selected.has(row))) return;
              press.current.pending = canDrag && !event.shiftKey && selected.size > 1 && selected.has(row);
              if (press.current.pending) return;
              const plain = event.button === 0 && !event.ctrlKey && !event.metaKey && !event.shiftKey;
              press.current.again = plain && cursorAt === at;
              onCursor(
                { row, column: at },
                event.ctrlKey || event.metaKey ? 'toggle' : event.shiftKey ? 'range' : 'one',
              );
            }}
            onClick={(event) => {
              const { onCursor, onEdit, editOnClick, opensOnClick } = grid.current;
              if (press.current.pending)
                onCursor({ row, column: at }, event.ctrlKey || event.metaKey ? 'toggle' : 'one');
              press.current.pending = false;
              if (editOnClick === true && press.current.again && !edited) onEdit?.({ row, column: at });
              press.current.again = false;
              const plain = !event.ctrlKey && !event.metaKey && !event.shiftKey;
              // The second click of a double click is meant for the field that the first one has opened.
              if (plain && event.detail <= 1 && !edited && opensOnClick?.(column) === true)
                onEdit?.({ row, column: at });
            }}
            onDoubleClick={() => {
              const { onEdit, opensOnClick } = grid.current;
              if (!edited && opensOnClick?.(column) !== true) onEdit?.({ row, column: at });
            }}
          >
            {edited ? props.editor?.(editing) : cell(row, column)}
          </div>
        );
      })}
    </div>
  );
});
