import { ArrowDown, ArrowUp, Bookmark as Icon, BookmarkX } from 'lucide-react';
import { useMemo, useState } from 'react';
import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { useProject } from '@/project/openProject';
import { objectPath } from '@/project/tree';
import { IconButton } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { FilterInput } from '@/ui/Filter';
import { Panel, PanelBar, PanelRest } from '@/ui/Panel';
import { placeColumns } from '@/ui/placeColumns';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import { findCommand } from '@/workbench/commands';
import { keysText } from '@/workbench/keys';
import { runCommand } from '@/workbench/run';
import { openBookmark } from './acts';
import styles from './BookmarksPanel.module.css';
import { inOrder, keyOf, type Bookmark } from './model';
import { clearBookmarks, useBookmarks } from './store';

interface Row extends Bookmark {
  readonly path: string;
}

/** The marked lines of the project. A click shows one, Enter or a double click leads there, Delete takes it away. */
export default function BookmarksPanel() {
  const t = useText();
  const projectId = useProject((state) => state.projectId);
  const { data: objects } = useObjects(projectId);
  const bookmarks = useBookmarks((state) => state.bookmarks);
  const [filter, setFilter] = useState('');
  const [selected, setSelected] = useState<string | null>(null);
  const rows = useMemo(
    (): Row[] =>
      inOrder(bookmarks, objects ?? []).map((mark) => ({ ...mark, path: objectPath(objects ?? [], mark.objectId) })),
    [bookmarks, objects],
  );
  const wanted = filter.trim().toLowerCase();
  const shown = rows.filter(({ path, text }) => `${path} ${text}`.toLowerCase().includes(wanted));
  const columns = useMemo(
    (): Column<Row>[] => [
      ...placeColumns<Row>(t),
      {
        id: 'text',
        title: t('crossReferences.text'),
        width: 260,
        grow: true,
        hint: (row) => row.text.trim(),
        cell: (row) => <span className={styles.code}>{row.text.trim()}</span>,
      },
    ],
    [t],
  );
  const none = rows.length === 0 ? t('bookmarks.none') : null;
  const key = findCommand('bookmarks.toggle')?.keys?.[0];

  return (
    <Panel>
      <PanelBar>
        <IconButton
          small
          icon={ArrowUp}
          label={t('bookmarks.previous')}
          disabledReason={none}
          onClick={() => runCommand('bookmarks.previous')}
        />
        <IconButton
          small
          icon={ArrowDown}
          label={t('bookmarks.next')}
          disabledReason={none}
          onClick={() => runCommand('bookmarks.next')}
        />
        <IconButton
          small
          icon={BookmarkX}
          label={t('bookmarks.clear')}
          disabledReason={none}
          onClick={() => runCommand('bookmarks.clear')}
        />
        <FilterInput className={styles.filter} label={t('crossReferences.filter')} value={filter} onValue={setFilter} />
      </PanelBar>
      <PanelRest>
        <Table
          label={t('bookmarks.title')}
          items={shown}
          columns={columns}
          keyOf={keyOf}
          selected={selected}
          onSelect={(row) => setSelected(row === null ? null : keyOf(row))}
          onOpen={(row) => openBookmark(row, objects ?? [])}
          onShow={(row) => openBookmark(row, objects ?? [], false)}
          onKey={(event, row) => {
            if (event.key === 'Delete' && row) clearBookmarks((mark) => keyOf(mark) === keyOf(row));
          }}
          empty={
            rows.length > 0 ? (
              <Empty title={t('bookmarks.allHidden')} />
            ) : (
              <Empty
                icon={Icon}
                title={t('bookmarks.none')}
                text={key === undefined ? undefined : t('bookmarks.start', { key: keysText(key) })}
              />
            )
          }
        />
      </PanelRest>
    </Panel>
  );
}
