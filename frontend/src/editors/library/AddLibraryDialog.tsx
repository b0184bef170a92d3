import { useState } from 'react';
import type { LibrarySummary } from '@/api/types';
import { useText } from '@/i18n';
import { search } from '@/workbench/palette/match';
import { Button } from '@/workbench/ui/Button';
import { Dialog } from '@/workbench/ui/Dialog';
import { Empty } from '@/workbench/ui/Empty';
import { TextInput } from '@/workbench/ui/Field';
import { Table } from '@/workbench/ui/Table';
import type { Column } from '@/workbench/ui/table';

/** Chooses an installed library to add. */
export function AddLibraryDialog({
  libraries,
  close,
}: {
  libraries: readonly LibrarySummary[];
  close: (names?: string[]) => void;
}) {
  const t = useText();
  const [query, setQuery] = useState('');
  const [selected, setSelected] = useState<string | null>(libraries[0]?.name ?? null);
  const hits = search(query, libraries, (library) => `${library.name} ${library.description}`).map((hit) => hit.entry);
  const chosen = hits.find((library) => library.name === selected) ?? hits[0];
  const columns: Column<LibrarySummary>[] = [
    {
      id: 'name',
      title: t('library.name'),
      width: 150,
      sort: (library) => library.name,
      cell: (library) => <span>{library.name}</span>,
    },
    { id: 'version', title: t('library.version'), width: 80, cell: (library) => <span>{library.version}</span> },
    {
      id: 'description',
      title: t('libraryDoc.comment'),
      width: 200,
      grow: true,
      hint: (library) => library.description,
      cell: (library) => <span>{library.description}</span>,
    },
  ];
  return (
    <Dialog
      title={t('library.add')}
      width={600}
      onClose={() => close()}
      onSubmit={() => chosen && close([chosen.name])}
      footer={
        <>
          <Button onClick={() => close()}>{t('action.cancel')}</Button>
          <Button type="submit" variant="primary" disabledReason={chosen ? null : t('library.chooseOne')}>
            {t('action.add')}
          </Button>
        </>
      }
    >
      <TextInput
        data-autofocus
        value={query}
        onValue={setQuery}
        placeholder={t('libraries.search')}
        aria-label={t('libraries.search')}
      />
      <div style={{ height: 280, border: '1px solid var(--line)', borderRadius: 'var(--radius)', overflow: 'hidden' }}>
        <Table
          label={t('library.add')}
          items={hits}
          columns={columns}
          keyOf={(library) => library.name}
          selected={chosen?.name ?? null}
          onSelect={(library) => setSelected(library?.name ?? null)}
          onOpen={(library) => close([library.name])}
          empty={<Empty title={t('palette.none')} />}
        />
      </div>
    </Dialog>
  );
}
