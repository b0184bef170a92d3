import type { LibrarySummary } from '@/api/types';
import type { useText } from '@/i18n';
import type { Column } from '@/ui/table';

type Text = ReturnType<typeof useText>;

/** The name of an installed library. */
export function nameColumn(t: Text): Column<LibrarySummary> {
  return {
    id: 'name',
    title: t('library.name'),
    width: 150,
    sort: (one) => one.name,
    cell: (one) => <span>{one.name}</span>,
  };
}

/** What an installed library is for, as wide as there is room. */
export function descriptionColumn(t: Text, width: number): Column<LibrarySummary> {
  return {
    id: 'description',
    title: t('libraries.description'),
    width,
    grow: true,
    cell: (one) => <span>{one.description}</span>,
    hint: (one) => one.description,
  };
}
