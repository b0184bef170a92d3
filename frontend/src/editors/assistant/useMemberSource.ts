import { kindOf, valuesOf } from '@/project/kinds';
import { useQueries } from '@tanstack/react-query';
import { useMemo } from 'react';
import { dataText } from '@/api/objects';
import { objectQuery, useObjects } from '@/api/queries';
import { parseDeclaration } from '@/iec/declaration/parse';
import { baseName, parseArrayType, type DeclaredMember, type MemberSource } from '@/iec/declaration/types';
import { useLibraries } from './useCatalog';

/** Scopes of a function block that an initial value may set. */
const SETTABLE = new Set(['VAR', 'VAR_INPUT', 'VAR_OUTPUT', 'STRUCT', 'UNION']);

function membersOf(declaration: string): readonly DeclaredMember[] | null {
  const model = parseDeclaration(declaration);
  if (model.problems.length > 0 || model.blocks[0]?.frame === 'enumeration') return null;
  return model.rows
    .filter((row) => row.special === null && row.type !== null && SETTABLE.has(model.blocks[row.block]?.scope ?? ''))
    .map((row) => ({ name: row.name.text, type: row.type?.text ?? '', initial: row.initial?.text ?? null }));
}

/** Names of all types that the text of a type mentions. */
function mentioned(type: string): string {
  let element = type;
  for (let array = parseArrayType(element); array !== null; array = parseArrayType(element)) element = array.element;
  return baseName(element);
}

/** Members of structures and function blocks by name, as far as `type` needs them. */
export function useMemberSource(projectId: string, type: string): MemberSource {
  const { data: objects } = useObjects(projectId);
  const libraries = useLibraries(projectId, undefined);
  const candidates = useMemo(
    () =>
      (objects ?? []).filter(
        (o) => (kindOf(o.kind)?.catalog === 'types' && o.subkind !== null) || valuesOf(o) === 'instance',
      ),
    [objects],
  );
  // Components of components are not known before: all data types of the project are few and cached.
  const wanted = mentioned(type) === '' ? [] : candidates;
  const texts = useQueries({
    queries: wanted.map((o) => objectQuery(projectId, o.id)),
    combine: (answers) => answers.flatMap((answer) => answer.data ?? []),
  });
  return useMemo(() => {
    const known = new Map<string, readonly DeclaredMember[] | null>();
    for (const library of libraries) {
      for (const item of library.items) {
        const pins = [...item.inputs, ...item.outputs, ...item.members];
        const members = pins.map((pin) => ({ name: pin.name, type: pin.type, initial: pin.default || null }));
        const name = library.qualified_only ? `${library.namespace}.${item.name}` : item.name;
        known.set(name.toUpperCase(), members.length > 0 ? members : null);
      }
    }
    for (const text of texts) known.set(text.name.toUpperCase(), membersOf(dataText(text, 'declaration')));
    return (name: string) => known.get(name.toUpperCase()) ?? null;
  }, [libraries, texts]);
}
