import { useVirtualizer } from '@tanstack/react-virtual';
import { ArrowDown, ArrowUp } from 'lucide-react';
import {
  useEffect,
  useId,
  useImperativeHandle,
  useRef,
  useState,
  type DragEvent,
  type KeyboardEvent,
  type ReactNode,
  type Ref,
} from 'react';
import { Grip } from '../Grip';
import { isMenuKey, openMenuAt } from '../menuKey';
import { useRowDrop, type RowDrop } from './useRowDrop';
import { cursorAfterKey, type GridCursor } from './cursor';
import styles from '../Table.module.css';

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

interface GridProps {
  label: string;
  columns: readonly GridColumn[];
  count: number;
  keyOf: (row: number) => string;
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
  empty?: ReactNode;
  ref?: Ref<GridHandle>;
}

const ROW_HEIGHT = 26;
const LEAST_WIDTH = 36;

/** A virtualised table with a cell cursor, several selected rows and editing in place. */
export function Grid(props: GridProps) {
  const { columns, count, cursor, editing = null, onCursor, onEdit, onKey } = props;
  const id = useId();
  const scroll = useRef<HTMLDivElement>(null);
  const [widths, setWidths] = useState<Readonly<Record<string, number>>>({});
  const virtual = useVirtualizer({
    count,
    getScrollElement: () => scroll.current,
    estimateSize: () => ROW_HEIGHT,
    overscan: 10,
    scrollPaddingStart: ROW_HEIGHT,
  });
  useImperativeHandle(props.ref, () => ({ focus: () => scroll.current?.focus() }), []);

  // The keyboard comes back to the table when a cell editor has closed.
  const wasEditing = useRef(false);
  useEffect(() => {
    if (wasEditing.current && editing === null && document.activeElement === document.body) scroll.current?.focus();
    wasEditing.current = editing !== null;
  }, [editing]);
  /** The button went down on the cell that had the cursor already. */
  const again = useRef(false);
  /** It went down on one of several chosen rows: they may be dragged, so it chooses only when it goes up. */
  const pending = useRef(false);
  const body = useRef<HTMLDivElement>(null);
  const dropping = useRowDrop(props.onDropRow, body, count, ROW_HEIGHT);
  const cursorRow = cursor?.row ?? -1;
  useEffect(() => {
    if (cursorRow >= 0 && cursorRow < count) virtual.scrollToIndex(cursorRow, { align: 'auto' });
    // Only a moved cursor scrolls; new rows above must not.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [cursorRow]);

  const items = virtual.getVirtualItems();
  const first = items[0]?.index ?? 0;
  const last = items[items.length - 1]?.index ?? 0;
  const { onRange } = props;
  useEffect(() => {
    onRange?.(first, last);
    // Called for other rows only, not for another function.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [first, last]);

  const onKeyDown = (event: KeyboardEvent) => {
    if (event.target !== scroll.current || onKey?.(event) === true) return;
    if (isMenuKey(event)) {
      event.preventDefault();
      openMenuAt(
        (cursor && document.getElementById(`${id}-${String(cursor.row)}-${String(cursor.column)}`)) ?? scroll.current,
      );
      return;
    }
    const page = Math.max(1, Math.floor((scroll.current.clientHeight ?? 260) / ROW_HEIGHT) - 2);
    const next = event.altKey ? null : cursorAfterKey(event.key, event.ctrlKey, cursor, count, columns.length, page);
    if (next !== null) {
      event.preventDefault();
      onCursor(next, event.shiftKey ? 'range' : 'one');
      return;
    }
    if (cursor === null || onEdit === undefined) return;
    const typed = event.key.length === 1 && event.key !== ' ' && !event.ctrlKey && !event.metaKey && !event.altKey;
    if (event.key === 'F2' || event.key === 'Enter' || typed) {
      event.preventDefault();
      event.stopPropagation();
      onEdit({ ...cursor, initial: typed ? event.key : undefined });
    }
  };

  const canDrag = props.onDragRow !== undefined && editing === null;
  const widthOf = (column: GridColumn) => {
    const width = widths[column.id] ?? column.width;
    const grows = column.grow === true && widths[column.id] === undefined;
    return grows
      ? { flex: `1 0 ${String(width)}px`, minWidth: width, width: 0 }
      : { flex: `0 0 ${String(width)}px`, width };
  };

  return (
    <div
      ref={scroll}
      className={`${styles.scroll} ${styles.sheet}`}
      role={props.level ? 'treegrid' : 'grid'}
      aria-label={props.label}
      aria-rowcount={count}
      aria-multiselectable
      aria-activedescendant={cursor && !editing ? `${id}-${String(cursor.row)}-${String(cursor.column)}` : undefined}
      tabIndex={0}
      onKeyDown={onKeyDown}
      {...dropping.listeners}
      onPointerDown={(event) => event.target === event.currentTarget && props.onEmptyClick?.()}
    >
      <div className={styles.head} role="row">
        {columns.map((column) => (
          <div
            key={column.id}
            role="columnheader"
            className={styles.headCell}
            style={widthOf(column)}
            data-sortable={column.sortable === true ? '' : undefined}
            aria-sort={
              props.sorting?.column === column.id ? (props.sorting.descending ? 'descending' : 'ascending') : undefined
            }
            onClick={column.sortable === true ? () => props.onSort?.(column.id) : undefined}
          >
            <span className={styles.headText}>{column.title}</span>
            {props.sorting?.column === column.id &&
              (props.sorting.descending ? <ArrowDown size={12} /> : <ArrowUp size={12} />)}
            <Grip onResize={(width) => setWidths({ ...widths, [column.id]: Math.max(LEAST_WIDTH, width) })} />
          </div>
        ))}
      </div>
      {count === 0 && props.empty}
      <div
        ref={body}
        className={styles.body}
        style={{ height: virtual.getTotalSize() }}
        role="presentation"
        onPointerDown={(event) => event.target === event.currentTarget && props.onEmptyClick?.()}
      >
        {dropping.at !== null && <div className={styles.dropMark} style={{ top: dropping.at * ROW_HEIGHT }} />}
        {items.map(({ index: row, start }) => (
          <div
            key={props.keyOf(row)}
            role="row"
            aria-rowindex={row + 1}
            aria-selected={props.selected.has(row)}
            aria-level={props.level?.(row)}
            aria-expanded={props.expanded?.(row)}
            className={styles.row}
            data-state={props.rowState?.(row)}
            style={{ transform: `translateY(${String(start)}px)` }}
            draggable={canDrag}
            onDragStart={(event) => props.onDragRow?.(row, event)}
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
                  style={widthOf(column)}
                  title={edited ? undefined : props.hint?.(row, column)}
                  onPointerDown={(event) => {
                    if (edited || (event.button !== 0 && props.selected.has(row))) return;
                    pending.current = canDrag && !event.shiftKey && props.selected.size > 1 && props.selected.has(row);
                    if (pending.current) return;
                    const plain = event.button === 0 && !event.ctrlKey && !event.metaKey && !event.shiftKey;
                    again.current = plain && cursor?.row === row && cursor.column === at;
                    onCursor(
                      { row, column: at },
                      event.ctrlKey || event.metaKey ? 'toggle' : event.shiftKey ? 'range' : 'one',
                    );
                  }}
                  onClick={(event) => {
                    if (pending.current)
                      onCursor({ row, column: at }, event.ctrlKey || event.metaKey ? 'toggle' : 'one');
                    pending.current = false;
                    if (props.editOnClick === true && again.current && !edited) onEdit?.({ row, column: at });
                    again.current = false;
                    const plain = !event.ctrlKey && !event.metaKey && !event.shiftKey;
                    // The second click of a double click is meant for the field that the first one has opened.
                    if (plain && event.detail <= 1 && !edited && props.opensOnClick?.(column) === true)
                      onEdit?.({ row, column: at });
                  }}
                  onDoubleClick={() =>
                    !edited && props.opensOnClick?.(column) !== true && onEdit?.({ row, column: at })
                  }
                >
                  {edited && editing ? props.editor?.(editing) : props.cell(row, column)}
                </div>
              );
            })}
          </div>
        ))}
      </div>
    </div>
  );
}
