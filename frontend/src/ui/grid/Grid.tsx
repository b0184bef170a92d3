import { useVirtualizer } from '@tanstack/react-virtual';
import { ArrowDown, ArrowUp } from 'lucide-react';
import { useEffect, useId, useImperativeHandle, useLayoutEffect, useRef, useState, type KeyboardEvent } from 'react';
import { Grip } from '../Grip';
import { isMenuKey, openMenuAt } from '../menuKey';
import type { GridProps } from './gridProps';
import { GridLayer } from './GridLayer';
import { GridRow, widthOf, type Press } from './GridRow';
import { useRowDrop } from './useRowDrop';
import { cursorAfterKey } from './cursor';
import styles from '../Table.module.css';

export type { GridColumn, GridEditing, GridHandle } from './gridProps';

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
    // The head takes a row of the view, and stands before the rows in the content: it covers none of them.
    scrollPaddingEnd: ROW_HEIGHT,
    // Rows beyond the screen are there already: no need to draw within the event of the wheel.
    useFlushSync: false,
  });
  const head = useRef<HTMLDivElement>(null);
  const given = useRef(props);
  useLayoutEffect(() => {
    given.current = props;
  });
  useImperativeHandle(props.ref, () => ({ focus: () => scroll.current?.focus() }), []);

  // The keyboard comes back to the table when a cell editor has closed.
  const wasEditing = useRef(false);
  useEffect(() => {
    if (wasEditing.current && editing === null && document.activeElement === document.body) scroll.current?.focus();
    wasEditing.current = editing !== null;
  }, [editing]);
  const press = useRef<Press>({ again: false, pending: false });
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
  const canDrag = props.onDragRow !== undefined && editing === null;
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
      <div ref={head} className={styles.head} role="row">
        {columns.map((column) => (
          <div
            key={column.id}
            role="columnheader"
            className={styles.headCell}
            style={widthOf(column, widths)}
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
        {items.map(({ index, start }) => (
          <GridRow
            key={props.keyOf(index)}
            grid={given}
            id={id}
            row={index}
            start={start}
            widths={widths}
            press={press}
            columns={columns}
            cell={props.cell}
            hint={props.hint}
            level={props.level}
            expanded={props.expanded}
            rowState={props.rowState}
            selected={props.selected.has(index)}
            cursorAt={cursor?.row === index ? cursor.column : -1}
            editing={editing?.row === index ? editing : null}
            editor={editing?.row === index ? props.editor : undefined}
            canDrag={canDrag}
          />
        ))}
        {props.layer && (
          <GridLayer
            head={head}
            at={columns.findIndex((column) => column.id === props.layer?.column)}
            draw={props.layer.draw}
            first={first}
            last={last}
            count={count}
            rowHeight={ROW_HEIGHT}
          />
        )}
      </div>
    </div>
  );
}
