import { useVirtualizer } from '@tanstack/react-virtual';
import { useId, useRef, type KeyboardEvent, type ReactNode } from 'react';

import { ARIA_CHECKED, ChoiceBox, type Checked } from './ChoiceBox';
import styles from './ChoiceTree.module.css';
import { rowAfterKey } from './table';
import { Twist } from './Twist';

/** As `.row` of the style sheet has it. */
const ROW_HEIGHT = 24;
const PAGE = 10;

export interface ChoiceTreeRow {
  /** From 1. */
  readonly level: number;
  readonly expandable: boolean;
  readonly expanded: boolean;
}

interface ChoiceTreeProps<Row extends ChoiceTreeRow> {
  /** Its accessible name. */
  label: string;
  className?: string;
  rows: readonly Row[];
  /** Index of the row with the keyboard's place. */
  at: number;
  goTo: (index: number) => void;
  keyOf: (row: Row) => string;
  tooltipOf: (row: Row) => string;
  /** Opens or closes a row. */
  twist: (row: Row) => void;
  /** What the box of a row shows; absent when nothing can be chosen. */
  checkedOf?: ((row: Row) => Checked) | undefined;
  toggle: (row: Row) => void;
  /** What stands in a row, after its box. */
  children: (row: Row) => ReactNode;
}

/** A tree of any length with a box for each row: arrows move, open and close, Space chooses. */
export function ChoiceTree<Row extends ChoiceTreeRow>(props: ChoiceTreeProps<Row>) {
  const { label, className, rows, at, goTo, keyOf, tooltipOf, twist, checkedOf, toggle, children } = props;
  const id = useId();
  const scroll = useRef<HTMLDivElement>(null);
  const virtual = useVirtualizer({
    count: rows.length,
    getScrollElement: () => scroll.current,
    estimateSize: () => ROW_HEIGHT,
    overscan: 10,
  });
  const onKeyDown = (event: KeyboardEvent) => {
    const row = rows[at];
    const to = rowAfterKey(event.key, at, rows.length, PAGE);
    if (to !== null) {
      goTo(to);
      virtual.scrollToIndex(to);
    } else if (!row) return;
    else if (event.key === ' ') toggle(row);
    else if (event.key === 'ArrowRight' && row.expandable && !row.expanded) twist(row);
    else if (event.key === 'ArrowLeft' && row.expandable && row.expanded) twist(row);
    else return;
    event.preventDefault();
  };
  return (
    <div
      ref={scroll}
      className={className ? `${styles.tree} ${className}` : styles.tree}
      role="tree"
      aria-label={label}
      aria-activedescendant={rows[at] ? `${id}-${at}` : undefined}
      tabIndex={0}
      onKeyDown={onKeyDown}
    >
      <div className={styles.rows} style={{ height: virtual.getTotalSize() }}>
        {virtual.getVirtualItems().map(({ index, start }) => {
          const row = rows[index]!;
          const checked = checkedOf?.(row);
          return (
            <div
              key={keyOf(row)}
              id={`${id}-${index}`}
              role="treeitem"
              aria-level={row.level}
              aria-expanded={row.expandable ? row.expanded : undefined}
              aria-checked={checked && ARIA_CHECKED[checked]}
              aria-selected={index === at}
              className={styles.row}
              style={{ transform: `translateY(${start}px)`, paddingLeft: 6 + (row.level - 1) * 16 }}
              title={tooltipOf(row)}
              onClick={() => goTo(index)}
              onDoubleClick={() => row.expandable && twist(row)}
            >
              <Twist open={row.expanded} expandable={row.expandable} onClick={() => row.expandable && twist(row)} />
              {checked && <ChoiceBox state={checked} toggle={() => toggle(row)} />}
              {children(row)}
            </div>
          );
        })}
      </div>
    </div>
  );
}
