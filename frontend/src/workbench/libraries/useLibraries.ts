import { useQueries, useQuery, type UseQueryResult } from '@tanstack/react-query';
import { librariesQuery, libraryQuery } from '@/api/queries';
import type { Library, LibraryItem, LibrarySummary } from '@/api/types';
import { useText } from '@/i18n';
import { idOf, type LibraryId } from './model';

/** The installed libraries in all their versions. */
export function useLibraries(): UseQueryResult<LibrarySummary[]> {
  return useQuery(librariesQuery);
}

/** An item that was chosen from a library, with its comments in the language of now; `library` may have a version. */
export function useItemOfNow(library: string | null, item: LibraryItem | null): LibraryItem | null {
  useText(); // another language is another answer
  const [name = '', version] = (library ?? '').split(', ');
  const { data } = useQuery({ ...libraryQuery(name, version), enabled: item !== null && name !== '' });
  return data?.items.find((one) => one.name === item?.name) ?? item;
}

/** The contents of several libraries by `idOf`, as far as they have arrived. */
export function useContents(libraries: readonly LibraryId[]): ReadonlyMap<string, Library> {
  return useQueries({
    queries: libraries.map(({ name, version }) => libraryQuery(name, version)),
    combine: (results) => new Map(results.flatMap(({ data }) => (data ? [[idOf(data), data] as const] : []))),
  });
}
