import { GitCompare } from 'lucide-react';
import { useState } from 'react';
import { useText } from '@/i18n';
import { ObjectIcon } from '@/project/ObjectIcon';
import { displayPath } from '@/project/objectName';
import { IconButton } from '@/ui/Button';
import { Select, TextInput } from '@/ui/Field';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import { ACTS, withChoice, type Choices, type ExistingRow } from './existing';
import styles from './Exchange.module.css';

interface ExistingTableProps {
  rows: readonly ExistingRow[];
  choices: Choices;
  wrong: ReadonlySet<string>;
  change: (choices: Choices) => void;
  compare: (row: ExistingRow) => void;
}

/** What becomes of each object whose name exists, or of all of them at once. */
export function ExistingTable({ rows, choices, wrong, change, compare }: ExistingTableProps) {
  const t = useText();
  const [selected, setSelected] = useState<string | null>(null);
  const acts = (known: readonly string[]) =>
    ACTS.filter((act) => known.includes(act)).map((value) => ({ value, text: t(`exchange.act.${value}`) }));
  const columns: Column<ExistingRow>[] = [
    {
      id: 'object',
      title: t('exchange.object'),
      width: 240,
      grow: true,
      sort: ({ existing }) => existing.path,
      hint: ({ existing }) => existing.path,
      cell: ({ node, existing }) => (
        <span className={styles.existing}>
          <ObjectIcon kind={node.kind} subkind={node.subkind} name={node.name} />
          <span>{displayPath(existing.path.split('/').slice(-2).join('/'))}</span>
          {existing.same && <small className={styles.muted}>{t('exchange.same')}</small>}
        </span>
      ),
    },
    {
      id: 'act',
      title: t('exchange.act'),
      width: 150,
      sort: ({ act }) => act,
      cell: ({ node, existing, act }) => (
        <Select
          compact
          label={t('exchange.actOf', { name: node.name })}
          value={act}
          choices={acts(existing.acts)}
          onValue={(value) => change(withChoice(choices, node.key, { act: value }))}
        />
      ),
    },
    {
      id: 'name',
      title: t('exchange.newName'),
      width: 190,
      cell: ({ node, act, name, joined }) =>
        act === 'rename' ? (
          <TextInput
            className={styles.newName}
            aria-label={t('exchange.newNameOf', { name: node.name })}
            aria-invalid={wrong.has(node.key) || undefined}
            value={name}
            onValue={(value) => change(withChoice(choices, node.key, { act, name: value }))}
          />
        ) : (
          <span className={styles.muted}>{joined ? t('exchange.joined') : ''}</span>
        ),
    },
    {
      id: 'compare',
      title: '',
      width: 40,
      cell: (row) => (
        <IconButton
          icon={GitCompare}
          small
          label={t('exchange.compare')}
          disabledReason={
            row.existing.acts.includes('merge')
              ? row.existing.same
                ? t('exchange.same')
                : null
              : t('exchange.otherKind')
          }
          onClick={() => compare(row)}
        />
      ),
    },
  ];
  return (
    <section className={styles.existingPart} aria-label={t('exchange.existing')}>
      <div className={styles.buttons}>
        <span className={styles.count}>{t('exchange.existingCount', { count: rows.length })}</span>
        <span className={styles.muted}>{t('exchange.forAll')}</span>
        <Select
          className={styles.forAll}
          label={t('exchange.forAll')}
          value={choices.all}
          choices={acts(ACTS)}
          onValue={(all) => change({ all, one: new Map() })}
        />
      </div>
      <div className={styles.table}>
        <Table
          label={t('exchange.existing')}
          items={rows}
          columns={columns}
          keyOf={({ node }) => node.key}
          selected={selected}
          onSelect={(row) => setSelected(row?.node.key ?? null)}
        />
      </div>
    </section>
  );
}
