import { useState } from 'react';
import type { LibraryReference, LibrarySummary } from '@/api/types';
import { useText } from '@/i18n';
import { descriptionColumn, nameColumn } from '@/workbench/libraries/columns';
import { search } from '@/workbench/palette/match';
import { FormDialog } from '@/ui/FormDialog';
import { Empty } from '@/ui/Empty';
import { TextInput } from '@/ui/Field';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import styles from './LibraryManager.module.css';
import { freshReference, namespaceFault, newestOf, versionsOf } from './model';
import { placeholderFault, ReferenceFields } from './ReferenceFields';

interface AddLibraryProps {
  references: readonly LibraryReference[];
  installed: readonly LibrarySummary[];
  close: (reference?: LibraryReference) => void;
}

/** Chooses an installed library to add, in which version and under which name (LIB-08, LIB-09). */
export function AddLibraryDialog({ references, installed, close }: AddLibraryProps) {
  const t = useText();
  const [query, setQuery] = useState('');
  const taken = new Set(references.map((reference) => reference.name.toUpperCase()));
  const offered = newestOf(installed);
  const hits = search(query, offered, (library) => `${library.name} ${library.description}`).map((hit) => hit.entry);
  const first = hits.find((library) => !taken.has(library.name.toUpperCase())) ?? hits[0];
  const [draft, setDraft] = useState<LibraryReference | null>(null);
  const shown = draft && hits.some((library) => library.name === draft.name || draft.placeholder) ? draft : null;
  const reference = shown ?? (first ? freshReference(first, references, installed) : null);
  const fault = reference && namespaceFault(reference, -1, references, installed);
  const refused = !reference
    ? t('library.chooseOne')
    : fault
      ? t(fault)
      : placeholderFault(reference)
        ? t('library.namespaceFault')
        : null;
  const choose = (library: LibrarySummary) => setDraft(freshReference(library, references, installed));

  const columns: Column<LibrarySummary>[] = [
    nameColumn(t),
    {
      id: 'versions',
      title: t('libraries.versions'),
      width: 150,
      cell: (one) => <span className="digits">{versionsText(one, installed)}</span>,
      hint: (one) => versionsText(one, installed),
    },
    {
      id: 'used',
      title: t('libraries.used'),
      width: 60,
      cell: (one) => <span>{taken.has(one.name.toUpperCase()) ? t('libraries.yes') : ''}</span>,
    },
    descriptionColumn(t, 160),
  ];
  return (
    <FormDialog
      title={t('library.add')}
      width={860}
      onClose={() => close()}
      onSubmit={() => reference && close(reference)}
      action={t('action.add')}
      disabledReason={refused}
    >
      <TextInput
        data-autofocus
        value={query}
        onValue={setQuery}
        placeholder={t('libraries.search')}
        aria-label={t('libraries.search')}
      />
      <div className={styles.offered}>
        <Table
          label={t('library.add')}
          items={hits}
          columns={columns}
          keyOf={(library) => library.name}
          selected={reference?.name ?? null}
          onSelect={(library) => library && choose(library)}
          onOpen={(library) => close(freshReference(library, references, installed))}
          empty={<Empty title={t('palette.none')} />}
        />
      </div>
      {reference && (
        <ReferenceFields
          reference={reference}
          at={-1}
          references={references}
          installed={installed}
          change={setDraft}
        />
      )}
    </FormDialog>
  );
}

function versionsText(library: LibrarySummary, installed: readonly LibrarySummary[]): string {
  return versionsOf(library.name, installed)
    .map((one) => one.version)
    .join(', ');
}
