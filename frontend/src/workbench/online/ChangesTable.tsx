import {
  CircleDot,
  CircleMinus,
  CornerDownRight,
  MoveRight,
  Replace,
  TextCursorInput,
  Unlink,
  type LucideIcon,
} from 'lucide-react';
import { useMemo, useState } from 'react';
import type { LoginAnswer } from '@/api/types';
import { actOnSymbol } from '../symbolActs';
import { useText } from '@/i18n';
import { Empty } from '@/ui/Empty';
import { FilterInput, FilterToggles } from '@/ui/Filter';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import { toggledIn } from '@/ui/toggleSet';
import {
  declaredAt,
  EFFECTS,
  effectCounts,
  hiddenAtFirst,
  shownChanges,
  typeText,
  type ChangedVariable,
  type Effect,
} from './changes';
import { bytesText } from '../messages/store';
import styles from './ChangesTable.module.css';

const ICONS: Record<Effect, LucideIcon> = {
  lost: CircleMinus,
  cleared: Unlink,
  initialised: CircleDot,
  converted: Replace,
  kept: TextCursorInput,
  follows: CornerDownRight,
  moved: MoveRight,
};

interface ChangesTableProps {
  answer: LoginAnswer;
  /** Called when a declaration is opened, so that a dialog may go out of the way. */
  onLeave?: () => void;
}

/** What an online change does to each variable and why; Enter and double click lead to its declaration. */
export function ChangesTable({ answer, onLeave }: ChangesTableProps) {
  const t = useText();
  const { changes } = answer;
  const [search, setSearch] = useState('');
  const [selected, setSelected] = useState<string | null>(null);
  const [chosen, setChosen] = useState<{ of: LoginAnswer; hidden: ReadonlySet<Effect> } | null>(null);
  const hidden = chosen?.of === answer ? chosen.hidden : hiddenAtFirst(changes);
  const counts = useMemo(() => effectCounts(changes), [changes]);
  const rows = useMemo(() => shownChanges(changes, hidden, search), [changes, hidden, search]);
  const columns: Column<ChangedVariable>[] = [
    {
      id: 'path',
      title: t('changes.variable'),
      width: 200,
      grow: true,
      cell: ({ path }) => <span className={styles.path}>{path}</span>,
      sort: ({ path }) => path,
      hint: ({ path }) => path,
    },
    {
      id: 'effect',
      title: t('changes.effect'),
      width: 110,
      cell: ({ effect }) => <EffectMark effect={effect} />,
      sort: ({ effect }) => EFFECTS.indexOf(effect),
    },
    {
      id: 'reason',
      title: t('changes.reason'),
      width: 220,
      cell: (row) => reasonText(row, t),
      sort: (row) => reasonText(row, t),
      hint: (row) => reasonText(row, t),
    },
    {
      id: 'type',
      title: t('changes.type'),
      width: 130,
      cell: (row) => <span className={styles.path}>{typeText(row)}</span>,
      sort: typeText,
      hint: typeText,
    },
  ];
  // Few changes call something: without them the paths have its room.
  if (changes.some(({ calls }) => calls.length > 0))
    columns.push({
      id: 'calls',
      title: t('changes.calls'),
      width: 130,
      cell: ({ calls }) => calls.join(', '),
      sort: ({ calls }) => calls.join(', '),
      hint: ({ calls }) => calls.join(', '),
    });
  return (
    <div className={styles.changes}>
      <div className={styles.bar}>
        <FilterToggles
          kinds={EFFECTS.filter((effect) => counts[effect] > 0)}
          hidden={hidden}
          toggle={(effect) => setChosen({ of: answer, hidden: toggledIn(hidden, effect) })}
        >
          {(effect) => (
            <>
              <EffectMark effect={effect} /> <span className="digits">{counts[effect]}</span>
            </>
          )}
        </FilterToggles>
        <FilterInput className={styles.search} label={t('changes.search')} value={search} onValue={setSearch} />
      </div>
      <div className={styles.rows}>
        <Table
          label={t('changes.title')}
          items={rows}
          columns={columns}
          keyOf={({ path, effect }) => `${effect} ${path}`}
          selected={selected}
          onSelect={(row) => setSelected(row && `${row.effect} ${row.path}`)}
          onOpen={({ path }) => {
            onLeave?.();
            actOnSymbol('goToDefinition', declaredAt(path));
          }}
          empty={<Empty title={t('changes.noneShown')} />}
        />
      </div>
      {(counts.moved > 0 || answer.retain_layout_changes || answer.changes_omitted > 0 || answer.reserve) && (
        <p className={styles.note}>
          {[
            counts.moved > 0 && t('changes.pointers'),
            answer.retain_layout_changes && t('changes.retain'),
            answer.reserve &&
              t('changes.reserve', {
                needed: bytesText(answer.reserve.needed),
                reserved: bytesText(answer.reserve.reserved),
              }),
            answer.changes_omitted > 0 && t('changes.omitted', { number: answer.changes_omitted }),
          ]
            .filter(Boolean)
            .join(' ')}
        </p>
      )}
    </div>
  );
}

function EffectMark({ effect }: { effect: Effect }) {
  const t = useText();
  const Icon = ICONS[effect];
  return (
    <span className={styles.effect} data-effect={effect}>
      <Icon size={13} aria-hidden />
      {t(`changes.effect.${effect}`)}
    </span>
  );
}

function reasonText({ reason, remanent }: ChangedVariable, t: ReturnType<typeof useText>): string {
  const text = t(`changes.reason.${reason}`);
  return remanent ? t('text.andMore', { text, more: 'RETAIN' }) : text;
}
