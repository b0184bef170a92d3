import { useQueries, useQuery, type UseQueryResult } from '@tanstack/react-query';
import { api } from '@/api/client';
import { keys } from '@/api/queries';
import type { Library, LibrarySummary } from '@/api/types';
import { idOf, type LibraryId } from './model';

/** The installed libraries in all their versions. */
export function useLibraries(): UseQueryResult<LibrarySummary[]> {
  return useQuery({
    queryKey: keys.libraries,
    queryFn: () => api.get<LibrarySummary[]>('/libraries'),
    staleTime: Infinity,
  });
}

/** How a library with all its items is fetched; without a version the newest one. */
export const contentsQuery = (name: string, version = '*') => ({
  queryKey: keys.library(name, version),
  queryFn: () => api.get<Library>(`/libraries/${encodeURIComponent(name)}`, { query: { version } }),
  staleTime: Infinity,
});

/** The contents of several libraries by `idOf`, as far as they have arrived. */
export function useContents(libraries: readonly LibraryId[]): ReadonlyMap<string, Library> {
  return useQueries({
    queries: libraries.map(({ name, version }) => contentsQuery(name, version)),
    combine: (results) => new Map(results.flatMap(({ data }) => (data ? [[idOf(data), data] as const] : []))),
  });
}
