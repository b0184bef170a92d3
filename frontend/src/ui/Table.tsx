import { useVirtualizer } from '@tanstack/react-virtual';
import { ArrowDown, ArrowUp } from 'lucide-react';
import { useId, useMemo, useRef, useState, type KeyboardEvent, type ReactNode } from 'react';
import { nextSorting, rowAfterKey, sorted, type Column, type Sorting } from './table';
import { Grip } from './Grip';
import { isMenuKey, openMenuAt } from './menuKey';
import styles from './Table.module.css';

const ROW_HEIGHT = 26;
const HEAD_HEIGHT = 26;
const MIN_WIDTH = 36;

interface TableProps<Item> {
  label: string;
  items: readonly Item[];
  columns: readonly Column<Item>[];
  keyOf: (item: Item) => string;
  selected: string | null;
  onSelect: (item: Item | null) => void;
  /** Double click and Enter. */
  onOpen?: (item: Item) => void;
  /** A single click, in lists of places to go to: shows the place, and the keyboard stays in the list. */
  onShow?: (item: Item) => void;
  /** Keys the table itself does not know (Delete, Alt+Up ...). */
  onKey?: (event: KeyboardEvent, item: Item | undefined) => void;
  /** Context menu around the rows. */
  empty?: ReactNode;
}

/** A virtualised table: any number of rows, keyboard, sorting by head, columns that can be dragged wider. */
export function Table<Item>(props: TableProps<Item>) {
  const { label, items, columns, keyOf, selected, onSelect, onOpen, onShow, onKey, empty } = props;
  const id = useId();
  const scroll = useRef<HTMLDivElement>(null);
  const [sorting, setSorting] = useState<Sorting | null>(null);
  const [widths, setWidths] = useState<Readonly<Record<string, number>>>({});
  const rows = useMemo(() => sorted(items, columns, sorting), [items, columns, sorting]);
  const at = rows.findIndex((item) => keyOf(item) === selected);
  const virtual = useVirtualizer({
    count: rows.length,
    getScrollElement: () => scroll.current,
    estimateSize: () => ROW_HEIGHT,
    overscan: 12,
    // The head stands before the rows in the content and covers none of them.
    scrollPaddingEnd: HEAD_HEIGHT,
  });

  const onKeyDown = (event: KeyboardEvent) => {
    if (event.target !== event.currentTarget) return;
    const page = Math.max(1, Math.floor((scroll.current?.clientHeight ?? 260) / ROW_HEIGHT) - 2);
    const next = event.ctrlKey || event.altKey ? null : rowAfterKey(event.key, at, rows.length, page);
    const item = rows[at];
    if (next !== null) {
      event.preventDefault();
      onSelect(rows[next] ?? null);
      virtual.scrollToIndex(next);
    } else if (event.key === 'Enter' && item && onOpen) {
      event.preventDefault();
      onOpen(item);
    } else if (isMenuKey(event)) {
      event.preventDefault();
      openMenuAt(document.getElementById(`${id}-${at}`) ?? event.currentTarget);
    } else onKey?.(event, item);
  };

  const widthOf = (column: Column<Item>) => {
    const width = widths[column.id] ?? column.width;
    return column.grow && widths[column.id] === undefined
      ? { flex: `1 0 ${width}px`, minWidth: width, width: 0 }
      : { flex: `0 0 ${width}px`, width };
  };

  return (
    <div className={styles.table}>
      <div
        ref={scroll}
        className={styles.scroll}
        // Without rows it is no grid: what is shown instead may hold a button.
        role={rows.length === 0 && empty !== undefined ? 'group' : 'grid'}
        aria-label={label}
        aria-rowcount={rows.length === 0 && empty !== undefined ? undefined : rows.length}
        aria-activedescendant={at >= 0 ? `${id}-${at}` : undefined}
        tabIndex={0}
        onKeyDown={onKeyDown}
      >
        <div className={styles.head} role="row" hidden={rows.length === 0 && empty !== undefined}>
          {columns.map((column) => (
            <div
              key={column.id}
              role="columnheader"
              className={`${styles.headCell} ${column.align === 'right' ? styles.right : ''}`}
              style={widthOf(column)}
              data-sortable={column.sort ? '' : undefined}
              aria-sort={sorting?.column === column.id ? (sorting.descending ? 'descending' : 'ascending') : undefined}
              onClick={column.sort && (() => setSorting(nextSorting(sorting, column.id)))}
            >
              <span className={styles.headText}>{column.title}</span>
              {sorting?.column === column.id && (sorting.descending ? <ArrowDown size={12} /> : <ArrowUp size={12} />)}
              <Grip onResize={(width) => setWidths({ ...widths, [column.id]: Math.max(MIN_WIDTH, width) })} />
            </div>
          ))}
        </div>
        {rows.length === 0 && empty ? (
          empty
        ) : (
          <div className={styles.body} style={{ height: virtual.getTotalSize() }} role="presentation">
            {virtual.getVirtualItems().map((entry) => {
              const item = rows[entry.index]!;
              return (
                <div
                  key={keyOf(item)}
                  id={`${id}-${entry.index}`}
                  role="row"
                  aria-rowindex={entry.index + 1}
                  aria-selected={entry.index === at}
                  className={styles.row}
                  style={{ transform: `translateY(${entry.start}px)` }}
                  onPointerDown={() => onSelect(item)}
                  onClick={onShow && ((event) => event.detail <= 1 && onShow(item))}
                  onDoubleClick={onOpen && (() => onOpen(item))}
                >
                  {columns.map((column) => (
                    <div
                      key={column.id}
                      role="gridcell"
                      className={`${styles.cell} ${column.align === 'right' ? styles.right : ''}`}
                      style={widthOf(column)}
                      title={column.hint?.(item)}
                    >
                      {column.cell(item)}
                    </div>
                  ))}
                </div>
              );
            })}
          </div>
        )}
      </div>
    </div>
  );
}
