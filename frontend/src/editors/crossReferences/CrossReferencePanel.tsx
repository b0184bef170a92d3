import { RefreshCw, Search, Waypoints } from 'lucide-react';
import { useMemo, useState } from 'react';
import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import type { Access } from '@/lsp/symbols';
import { openObject } from '@/workbench/docking/dock';
import { guard } from '@/ui/notices';
import { useProject } from '@/project/openProject';
import { useToggleSet } from '@/ui/toggleSet';
import { IconButton } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { TextInput } from '@/ui/Field';
import { FilterInput, FilterToggles } from '@/ui/Filter';
import { Panel, PanelBar, PanelRest } from '@/ui/Panel';
import { placeColumns } from '@/ui/placeColumns';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import styles from './CrossReferencePanel.module.css';
import { ACCESSES, filtered, rowsOf, type Row } from './rows';
import { findCrossReferences, refreshCrossReferences, useCrossReferences } from './store';

/** Cross References: every place of a symbol with its kind of access. Enter or a double click leads to the place. */
export default function CrossReferencePanel() {
  const t = useText();
  const projectId = useProject((state) => state.projectId);
  const { data: objects } = useObjects(projectId);
  const { question, name, busy, places, projectId: askedIn } = useCrossReferences();
  const [typed, setTyped] = useState<{ name: string; text: string }>({ name: '', text: '' });
  const [hidden, toggle] = useToggleSet<Access>();
  const [filter, setFilter] = useState('');
  const [selected, setSelected] = useState<string | null>(null);
  const rows = useMemo(
    () => (askedIn === projectId ? rowsOf(places, objects ?? []) : []),
    [places, objects, askedIn, projectId],
  );
  const shown = useMemo(() => filtered(rows, hidden, filter), [rows, hidden, filter]);
  // What is typed counts until something else is asked for.
  const text = typed.name === name ? typed.text : name;

  const ask = () => {
    const wanted = text.trim();
    if (wanted !== '' && projectId !== null) {
      setTyped({ name: wanted, text: wanted });
      void guard(() => findCrossReferences(projectId, { name: wanted }, wanted));
    }
  };
  const columns = useMemo(
    (): Column<Row>[] => [
      {
        id: 'symbol',
        title: t('crossReferences.symbol'),
        width: 180,
        sort: (row) => row.symbol,
        hint: (row) => row.symbol,
        cell: (row) => <span className={styles.code}>{row.symbol}</span>,
      },
      {
        id: 'access',
        title: t('crossReferences.access'),
        width: 100,
        sort: (row) => ACCESSES.indexOf(row.access),
        cell: (row) => <span className={styles[row.access]}>{t(`crossReferences.${row.access}`)}</span>,
      },
      ...placeColumns<Row>(t),
      {
        id: 'text',
        title: t('crossReferences.text'),
        width: 260,
        grow: true,
        hint: (row) => row.text.join(''),
        cell: (row) => (
          <span className={styles.code}>
            {row.text[0]}
            <mark>{row.text[1]}</mark>
            {row.text[2]}
          </span>
        ),
      },
    ],
    [t],
  );
  const jump = (row: Row, focus: boolean) => {
    const object = objects?.find((candidate) => candidate.id === row.objectId);
    if (object === undefined) return;
    const { part, line, column, endColumn } = row;
    openObject(object.id, object.name, { focus, place: { part, line, column, endLine: line, endColumn } });
  };

  return (
    <Panel>
      <PanelBar>
        <TextInput
          className={styles.name}
          value={text}
          onValue={(next) => setTyped({ name, text: next })}
          onKeyDown={(event) => event.key === 'Enter' && ask()}
          placeholder={t('crossReferences.name')}
          aria-label={t('crossReferences.name')}
          spellCheck={false}
          data-autofocus
        />
        <IconButton
          small
          icon={Search}
          label={t('crossReferences.find')}
          disabledReason={text.trim() === '' ? t('crossReferences.nameNeeded') : null}
          onClick={ask}
        />
        <IconButton
          small
          icon={RefreshCw}
          label={t('crossReferences.refresh')}
          disabledReason={question === null ? t('crossReferences.nameNeeded') : null}
          onClick={() => void guard(refreshCrossReferences)}
        />
        <FilterToggles kinds={ACCESSES} hidden={hidden} toggle={toggle}>
          {(access) => `${t(`crossReferences.${access}`)} ${rows.filter((row) => row.access === access).length}`}
        </FilterToggles>
        <FilterInput className={styles.filter} label={t('crossReferences.filter')} value={filter} onValue={setFilter} />
      </PanelBar>
      <PanelRest>
        <Table
          label={t('panel.crossReferences')}
          items={shown}
          columns={columns}
          keyOf={(row) => row.key}
          selected={selected}
          onSelect={(row) => setSelected(row?.key ?? null)}
          onOpen={(row) => jump(row, true)}
          onShow={(row) => jump(row, false)}
          empty={<Nothing asked={question !== null} busy={busy} filtered={rows.length > 0} name={name} />}
        />
      </PanelRest>
    </Panel>
  );
}

function Nothing({ asked, busy, filtered, name }: { asked: boolean; busy: boolean; filtered: boolean; name: string }) {
  const t = useText();
  if (busy) return <Empty title={t('crossReferences.busy')} />;
  if (filtered) return <Empty title={t('crossReferences.allHidden')} />;
  if (asked)
    return <Empty icon={Waypoints} title={t('crossReferences.none', { name })} text={t('crossReferences.noneText')} />;
  return <Empty icon={Waypoints} title={t('crossReferences.start')} text={t('crossReferences.startText')} />;
}
