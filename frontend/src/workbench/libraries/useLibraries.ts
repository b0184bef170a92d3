import { useQueries, useQuery, type UseQueryResult } from '@tanstack/react-query';
import { librariesQuery, libraryQuery } from '@/api/queries';
import type { Library, LibrarySummary } from '@/api/types';
import { idOf, type LibraryId } from './model';

/** The installed libraries in all their versions. */
export function useLibraries(): UseQueryResult<LibrarySummary[]> {
  return useQuery(librariesQuery);
}

/** The contents of several libraries by `idOf`, as far as they have arrived. */
export function useContents(libraries: readonly LibraryId[]): ReadonlyMap<string, Library> {
  return useQueries({
    queries: libraries.map(({ name, version }) => libraryQuery(name, version)),
    combine: (results) => new Map(results.flatMap(({ data }) => (data ? [[idOf(data), data] as const] : []))),
  });
}
