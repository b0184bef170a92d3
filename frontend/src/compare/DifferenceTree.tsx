import { useVirtualizer } from '@tanstack/react-virtual';
import { useId, useMemo, useRef, type KeyboardEvent } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { ObjectIcon } from '@/project/ObjectIcon';
import { useToggleSet } from '@/ui/toggleSet';
import { ARIA_CHECKED, ChoiceBox } from '@/ui/ChoiceBox';
import { treeKey } from '@/ui/treeKeys';
import { Twist } from '@/ui/Twist';
import { checkedOf, diffRows, toggled, type Choices, type Difference, type DiffRow } from './comparison';
import styles from './compare.module.css';
import { StateMark } from './StateMark';

const ROW_HEIGHT = 24;

interface DifferenceTreeProps {
  differences: readonly Difference[];
  known: ReadonlyMap<string, ObjectSummary>;
  /** Path and difference of the row in hand. */
  selected: string | null;
  select: (row: DiffRow) => void;
  choices: Choices;
  /** Null: nothing can be taken over. */
  choose: ((choices: Choices) => void) | null;
}

const idOf = (row: DiffRow) => row.difference?.key ?? row.path;

/** What differs, in the objects that it stands in: arrows move, open and close; Space chooses what is taken over. */
export function DifferenceTree({ differences, known, selected, select, choices, choose }: DifferenceTreeProps) {
  const t = useText();
  const id = useId();
  const scroll = useRef<HTMLDivElement>(null);
  const [closed, toggleClosed] = useToggleSet<string>();
  const rows = useMemo(() => diffRows(differences, closed, known), [differences, closed, known]);
  const at = Math.max(
    0,
    rows.findIndex((row) => idOf(row) === selected),
  );
  const virtual = useVirtualizer({
    count: rows.length,
    getScrollElement: () => scroll.current,
    estimateSize: () => ROW_HEIGHT,
    overscan: 10,
  });
  const goTo = (index: number) => {
    select(rows[index]!);
    virtual.scrollToIndex(index);
  };
  const toggle = (row: DiffRow) => choose?.(toggled(row.keys, choices));
  const twist = (row: DiffRow) => toggleClosed(row.path);
  const onKeyDown = (event: KeyboardEvent) => treeKey(event, rows, at, { goTo, twist, toggle });
  return (
    <div
      ref={scroll}
      className={styles.tree}
      role="tree"
      aria-label={t('compare.differences')}
      aria-activedescendant={rows[at] ? `${id}-${at}` : undefined}
      tabIndex={0}
      onKeyDown={onKeyDown}
    >
      <div className={styles.rows} style={{ height: virtual.getTotalSize() }}>
        {virtual.getVirtualItems().map(({ index, start }) => {
          const row = rows[index]!;
          const checked = checkedOf(row.keys, choices);
          const was = row.difference?.renamed ? row.difference.old?.name : null;
          return (
            <div
              key={idOf(row)}
              id={`${id}-${index}`}
              role="treeitem"
              aria-level={row.level}
              aria-expanded={row.expandable ? row.expanded : undefined}
              aria-checked={choose ? ARIA_CHECKED[checked] : undefined}
              aria-selected={index === at}
              className={styles.node}
              style={{ transform: `translateY(${start}px)`, paddingLeft: 4 + (row.level - 1) * 14 }}
              title={row.path}
              onClick={() => select(row)}
              onDoubleClick={() => row.expandable && toggleClosed(row.path)}
            >
              <Twist open={row.expanded} expandable={row.expandable} onClick={() => toggleClosed(row.path)} />
              {choose && <ChoiceBox state={checked} toggle={() => toggle(row)} />}
              {row.kind && <ObjectIcon kind={row.kind} subkind={row.subkind} name={row.name} />}
              <span className={row.difference ? styles.name : styles.context}>
                {was ? `${row.name} ← ${was}` : row.name}
              </span>
              {row.difference && <StateMark state={row.difference.state} />}
            </div>
          );
        })}
      </div>
    </div>
  );
}
