import { useMemo } from 'react';

import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { ObjectIcon } from '@/project/ObjectIcon';
import { ChoiceTree } from '@/ui/ChoiceTree';
import { useToggleSet } from '@/ui/toggleSet';
import { checkedOf, diffRows, toggled, type Choices, type Difference, type DiffRow } from './comparison';
import styles from './compare.module.css';
import { StateMark } from './StateMark';

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

/** What differs, in the objects that it stands in, with boxes for what is taken over. */
export function DifferenceTree({ differences, known, selected, select, choices, choose }: DifferenceTreeProps) {
  const t = useText();
  const [closed, toggleClosed] = useToggleSet<string>();
  const rows = useMemo(() => diffRows(differences, closed, known), [differences, closed, known]);
  const at = Math.max(
    0,
    rows.findIndex((row) => idOf(row) === selected),
  );
  return (
    <ChoiceTree
      label={t('compare.differences')}
      className={styles.differences}
      rows={rows}
      at={at}
      goTo={(index) => select(rows[index]!)}
      keyOf={idOf}
      tooltipOf={(row) => row.path}
      twist={(row) => toggleClosed(row.path)}
      checkedOf={choose ? (row) => checkedOf(row.keys, choices) : undefined}
      toggle={(row) => choose?.(toggled(row.keys, choices))}
    >
      {(row) => <Entry row={row} />}
    </ChoiceTree>
  );
}

function Entry({ row }: { row: DiffRow }) {
  const was = row.difference?.renamed ? row.difference.old?.name : null;
  return (
    <>
      {row.kind && <ObjectIcon kind={row.kind} subkind={row.subkind} name={row.name} />}
      <span className={row.difference ? styles.name : styles.context}>{was ? `${row.name} ← ${was}` : row.name}</span>
      {row.difference && <StateMark state={row.difference.state} />}
    </>
  );
}
