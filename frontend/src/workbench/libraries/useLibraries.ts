import { useQueries, useQuery, type UseQueryResult } from '@tanstack/react-query';
import { api } from '@/api/client';
import { keys } from '@/api/queries';
import type { Library, LibrarySummary } from '@/api/types';

/** The installed libraries. */
export function useLibraries(): UseQueryResult<LibrarySummary[]> {
  return useQuery({
    queryKey: keys.libraries,
    queryFn: () => api.get<LibrarySummary[]>('/libraries'),
    staleTime: Infinity,
  });
}

/** How a library with all its items is fetched. */
export const contentsQuery = (name: string) => ({
  queryKey: keys.library(name),
  queryFn: () => api.get<Library>(`/libraries/${encodeURIComponent(name)}`),
  staleTime: Infinity,
});

/** One library with all its items; null asks for none. */
export function useLibrary(name: string | null): UseQueryResult<Library> {
  return useQuery({ ...contentsQuery(name ?? ''), enabled: name !== null });
}

/** The contents of several libraries by name, as far as they have arrived. */
export function useContents(names: readonly string[]): ReadonlyMap<string, Library> {
  return useQueries({
    queries: names.map(contentsQuery),
    combine: (results) => new Map(results.flatMap(({ data }) => (data ? [[data.name, data] as const] : []))),
  });
}
