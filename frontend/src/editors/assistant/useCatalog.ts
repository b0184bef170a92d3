import { hasRole, ofRole, valuesOf } from '@/project/kinds';
import { useQueries, useQuery } from '@tanstack/react-query';
import { useMemo } from 'react';
import { dataText, shaped } from '@/api/objects';
import { librariesQuery, libraryQuery, objectQuery, useObjects } from '@/api/queries';
import type { Library, ObjectSummary } from '@/api/types';
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
} from './catalog';

/** The libraries that are visible at this object, with all their items. */
export function useLibraries(projectId: string, object: ObjectSummary | undefined): readonly Library[] {
  const { data: objects } = useObjects(projectId);
  const application = object && objects ? applicationOf(objects, object.id) : undefined;
  const manager = objects?.find(
    (o) => hasRole(o, 'libraries') && (application === undefined || o.parent_id === application.id),
  );
  const installed = useQuery(librariesQuery);
  const chosen = useQuery({
    ...objectQuery(projectId, manager?.id ?? ''),
    select: (found) => shaped(found, ofRole('libraries')),
    enabled: manager !== undefined,
  });
  const references = manager === undefined ? null : (chosen.data?.data.references ?? []);
  const names = referenced(
    references,
    (installed.data ?? []).map((library) => library.name),
  );
  return useQueries({
    queries: names.map((name) => libraryQuery(name)),
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
    queries: [...owners, ...lists].map((o) => objectQuery(projectId, o.id)),
    combine: (answers) => answers.flatMap((answer) => answer.data ?? []),
  });
  return useMemo(() => {
    const local = owners.flatMap((owner) => {
      const text = texts.find((candidate) => candidate.id === owner.id);
      return text === undefined ? [] : variableEntries(dataText(text, 'declaration'), owner.name, '');
    });
    const global = lists.flatMap((list) => {
      const text = texts.find((candidate) => candidate.id === list.id);
      if (text === undefined) return [];
      const declaration = dataText(text, 'declaration');
      return variableEntries(declaration, list.name, isQualifiedOnly(declaration) ? `${list.name}.` : '');
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
