import { Copy, Download } from 'lucide-react';
import { useState } from 'react';
import type { ImportEntry } from '@/api/types';
import { useText } from '@/i18n';
import { saveBlob } from '../downloadFile';
import { guard, notify } from '@/ui/notices';
import { useToggleSet } from '@/ui/toggleSet';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { FilterInput, FilterToggles } from '@/ui/Filter';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import styles from './Exchange.module.css';
import { countOutcomes, OUTCOMES, placeText, reportText, shownEntries, type Outcome } from './model';

interface ReportViewProps {
  entries: readonly ImportEntry[];
  /** Kinds that are left out at first. */
  hide?: readonly Outcome[];
  /** Opens the object of an entry. */
  open?: (entry: ImportEntry) => void;
}

/** The report of an import: filtered by outcome and text, copied, saved; a double click opens an object. */
export function ReportView({ entries, hide = [], open }: ReportViewProps) {
  const t = useText();
  const [hidden, toggle] = useToggleSet<Outcome>(hide);
  const [search, setSearch] = useState('');
  const [selected, setSelected] = useState<string | null>(null);
  const count = countOutcomes(entries);
  const shown = shownEntries(entries, hidden, search).map((entry, at) => ({ entry, key: String(at) }));
  const text = () => reportText(shown.map(({ entry }) => entry));
  const columns: Column<(typeof shown)[number]>[] = [
    {
      id: 'outcome',
      title: t('exchange.outcome'),
      width: 90,
      sort: ({ entry }) => OUTCOMES.indexOf(entry.outcome),
      cell: ({ entry }) => <span data-outcome={entry.outcome}>{t(`exchange.outcome.${entry.outcome}`)}</span>,
    },
    {
      id: 'object',
      title: t('exchange.object'),
      width: 220,
      grow: true,
      sort: ({ entry }) => entry.object,
      cell: ({ entry }) => <span className="code">{entry.object}</span>,
      hint: ({ entry }) => entry.object,
    },
    {
      id: 'text',
      title: t('exchange.what'),
      width: 240,
      grow: true,
      cell: ({ entry }) => <span>{entry.text}</span>,
      hint: ({ entry }) => entry.text,
    },
    {
      id: 'place',
      title: t('exchange.place'),
      width: 170,
      sort: ({ entry }) => entry.source,
      cell: ({ entry }) => <span>{placeText(entry)}</span>,
      hint: ({ entry }) => placeText(entry),
    },
  ];
  return (
    <div className={styles.report}>
      <div className={styles.buttons}>
        <FilterToggles kinds={OUTCOMES.filter((outcome) => count[outcome] > 0)} hidden={hidden} toggle={toggle}>
          {(outcome) =>
            t('exchange.outcomeCount', { count: count[outcome], outcome: t(`exchange.outcome.${outcome}`) })
          }
        </FilterToggles>
        <FilterInput className={styles.filter} label={t('exchange.filter')} value={search} onValue={setSearch} />
        <Button
          icon={Copy}
          onClick={() =>
            void guard(async () => {
              await navigator.clipboard.writeText(text());
              notify({ tone: 'ok', title: t('exchange.copied') });
            })
          }
        >
          {t('exchange.copy')}
        </Button>
        <Button
          icon={Download}
          onClick={() => saveBlob(new Blob([text()], { type: 'text/plain' }), t('exchange.reportFile'))}
        >
          {t('exchange.save')}
        </Button>
      </div>
      <div className={styles.table}>
        <Table
          label={t('exchange.report')}
          items={shown}
          columns={columns}
          keyOf={({ key }) => key}
          selected={selected}
          onSelect={(item) => setSelected(item?.key ?? null)}
          onOpen={open && (({ entry }) => open(entry))}
          empty={<Empty title={t('exchange.noEntries')} />}
        />
      </div>
    </div>
  );
}
