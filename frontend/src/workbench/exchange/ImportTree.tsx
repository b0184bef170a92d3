import { useVirtualizer } from '@tanstack/react-virtual';
import { useId, useMemo, useRef, useState, type KeyboardEvent } from 'react';

import { useText } from '@/i18n';
import { ObjectIcon } from '@/project/ObjectIcon';
import { useToggleSet } from '@/ui/toggleSet';
import { ARIA_CHECKED, ChoiceBox } from '@/ui/ChoiceBox';
import { treeKey } from '@/ui/treeKeys';
import { Twist } from '@/ui/Twist';
import { checkedOf, nodeRows, toggled, type NodeForest, type NodeRow } from './model';
import styles from './Exchange.module.css';

const ROW_HEIGHT = 24;

interface ImportTreeProps {
  forest: NodeForest;
  chosen: ReadonlySet<string>;
  search: string;
  change: (chosen: ReadonlySet<string>) => void;
}

/** What the files hold, each object with a box: Space checks, arrows move, open and close. */
export function ImportTree({ forest, chosen, search, change }: ImportTreeProps) {
  const t = useText();
  const id = useId();
  const scroll = useRef<HTMLDivElement>(null);
  const [closed, toggleClosed] = useToggleSet<string>();
  const [focused, setFocused] = useState(0);
  const rows = useMemo(() => nodeRows(forest, closed, search), [forest, closed, search]);
  const checked = useMemo(() => checkedOf(forest, chosen), [forest, chosen]);
  const at = Math.min(focused, rows.length - 1);
  const virtual = useVirtualizer({
    count: rows.length,
    getScrollElement: () => scroll.current,
    estimateSize: () => ROW_HEIGHT,
    overscan: 10,
  });
  const goTo = (index: number) => {
    setFocused(index);
    virtual.scrollToIndex(index);
  };
  const twist = (row: NodeRow) => {
    if (row.expandable) toggleClosed(row.node.key);
  };
  const toggle = (row: NodeRow) => change(toggled(forest, chosen, row.node.key));
  const onKeyDown = (event: KeyboardEvent) => treeKey(event, rows, at, { goTo, twist, toggle });
  return (
    <div
      ref={scroll}
      className={styles.tree}
      role="tree"
      aria-label={t('exchange.contents')}
      aria-activedescendant={rows[at] ? `${id}-${at}` : undefined}
      tabIndex={0}
      onKeyDown={onKeyDown}
    >
      <div className={styles.rows} style={{ height: virtual.getTotalSize() }}>
        {virtual.getVirtualItems().map(({ index, start }) => {
          const row = rows[index]!;
          const state = checked.get(row.node.key) ?? 'none';
          return (
            <div
              key={row.node.key}
              id={`${id}-${index}`}
              role="treeitem"
              aria-level={row.level}
              aria-expanded={row.expandable ? row.expanded : undefined}
              aria-checked={ARIA_CHECKED[state]}
              aria-selected={index === at}
              className={styles.node}
              style={{ transform: `translateY(${start}px)`, paddingLeft: 6 + (row.level - 1) * 16 }}
              title={row.node.line === null ? row.node.source : `${row.node.source}:${row.node.line}`}
              onPointerDown={() => setFocused(index)}
              onDoubleClick={() => twist(row)}
            >
              <Twist open={row.expanded} expandable={row.expandable} onClick={() => twist(row)} />
              <ChoiceBox state={state} toggle={() => toggle(row)} />
              <ObjectIcon kind={row.node.kind} subkind={row.node.subkind} name={row.node.name} />
              <span data-excluded={row.node.excluded ? '' : undefined} className={styles.nodeName}>
                {row.node.name}
              </span>
            </div>
          );
        })}
      </div>
    </div>
  );
}
