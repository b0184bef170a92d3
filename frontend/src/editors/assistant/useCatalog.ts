import { hasRole, valuesOf } from '@/project/kinds';
import { useQueries, useQuery } from '@tanstack/react-query';
import { useMemo } from 'react';
import { api } from '@/api/client';
import { keys, useObjects } from '@/api/queries';
import type { LibraryManagerData, ObjectSummary, ProjectObject, TextData } from '@/api/types';
import { useText } from '@/i18n';
import { applicationOf } from '@/project/tree';
import {
  asReferenced,
  isQualifiedOnly,
  languageEntries,
  libraryEntries,
  objectEntries,
  referenced,
  variableEntries,
  type Entry,
  type LibraryDetail,
} from './catalog';

function objectQuery<Data>(projectId: string, id: string) {
  return {
    queryKey: keys.object(projectId, id),
    queryFn: () => api.get<ProjectObject<Data>>(`/projects/${projectId}/objects/${id}`),
    staleTime: Infinity,
  };
}

/** The libraries that are visible at this object, with all their items. */
export function useLibraries(projectId: string, object: ObjectSummary | undefined): readonly LibraryDetail[] {
  const { data: objects } = useObjects(projectId);
  const application = object && objects ? applicationOf(objects, object.id) : undefined;
  const manager = objects?.find(
    (o) => hasRole(o, 'libraries') && (application === undefined || o.parent_id === application.id),
  );
  const installed = useQuery({ queryKey: keys.libraries, queryFn: () => api.get<{ name: string }[]>('/libraries') });
  const chosen = useQuery({
    ...objectQuery<LibraryManagerData>(projectId, manager?.id ?? ''),
    enabled: manager !== undefined,
  });
  const references = manager === undefined ? null : (chosen.data?.data.references ?? []);
  const names = referenced(
    references,
    (installed.data ?? []).map((library) => library.name),
  );
  return useQueries({
    queries: names.map((name) => ({
      queryKey: keys.library(name),
      queryFn: () => api.get<LibraryDetail>(`/libraries/${encodeURIComponent(name)}`),
      staleTime: Infinity,
    })),
    combine: (answers) =>
      answers.flatMap(({ data }) =>
        data
          ? asReferenced(
              data,
              references?.find((reference) => reference.name === data.name),
            )
          : [],
      ),
  });
}

/** Everything the input assistant offers at this object (F2). */
export function useCatalog(projectId: string, object: ObjectSummary | undefined): readonly Entry[] {
  const t = useText();
  const { data: objects } = useObjects(projectId);
  const libraries = useLibraries(projectId, object);
  const owners = useMemo(() => ownersOf(objects ?? [], object), [objects, object]);
  const lists = useMemo(() => (objects ?? []).filter((o) => valuesOf(o) === 'global'), [objects]);
  const texts = useQueries({
    queries: [...owners, ...lists].map((o) => objectQuery<TextData>(projectId, o.id)),
    combine: (answers) => answers.flatMap((answer) => answer.data ?? []),
  });
  return useMemo(() => {
    const local = owners.flatMap((owner) => {
      const text = texts.find((candidate) => candidate.id === owner.id);
      return text === undefined ? [] : variableEntries(text.data.declaration, owner.name, '');
    });
    const global = lists.flatMap((list) => {
      const text = texts.find((candidate) => candidate.id === list.id);
      if (text === undefined) return [];
      return variableEntries(
        text.data.declaration,
        list.name,
        isQualifiedOnly(text.data.declaration) ? `${list.name}.` : '',
      );
    });
    return [
      ...local,
      ...global,
      ...objectEntries(objects ?? [], t('assistant.project')),
      ...libraries.flatMap(libraryEntries),
      ...languageEntries({
        types: t('assistant.elementary'),
        keywords: t('assistant.keywords'),
        operators: t('assistant.operators'),
        functions: t('assistant.functions'),
      }),
    ];
  }, [t, owners, lists, texts, objects, libraries]);
}

/** The object itself and, where it belongs to a POU, what lies between and that POU. */
function ownersOf(objects: readonly ObjectSummary[], object: ObjectSummary | undefined): ObjectSummary[] {
  const found: ObjectSummary[] = [];
  for (let at = object; at !== undefined; at = objects.find((o) => o.id === at?.parent_id)) {
    const place = valuesOf(at);
    if (place === undefined || place === 'global') break;
    found.push(at);
  }
  return found;
}
