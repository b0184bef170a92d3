/**
 * Everything that can be inserted in a text, by category: variables, types, POUs, keywords and operators.
 * Gathered from the project's declarations and the libraries its library manager names. Pure functions.
 */
import { kindOf, kindOfSubkind, valuesOf } from '@/project/kinds';
import type { Library, LibraryReference, ObjectSummary } from '@/api/types';
import { parseDeclaration } from '@/iec/declaration/parse';
import { joinComments } from '@/iec/declaration/comments';
import {
  CONSTANT_KEYWORDS,
  DECLARATION_KEYWORDS,
  ELEMENTARY_TYPES,
  NUMERIC_TYPES,
  OPERATOR_FUNCTIONS,
  OPERATOR_KEYWORDS,
  STATEMENT_KEYWORDS,
} from '@/iec/grammar';

export const CATEGORIES = ['variables', 'types', 'pous', 'keywords'] as const;
export type Category = (typeof CATEGORIES)[number];

export interface Entry {
  readonly name: string;
  /** What is put into the text. */
  readonly insert: string;
  /** Type of a variable, kind of a POU or type. */
  readonly detail: string;
  readonly comment: string;
  /** Heading under which it is shown: the POU, list or library it comes from. */
  readonly group: string;
  readonly category: Category;
}

/** The variables of one declaration; `prefix` goes in front of the name (a list's name, or nothing for locals). */
export function variableEntries(declaration: string, group: string, prefix: string): Entry[] {
  const model = parseDeclaration(declaration);
  return model.rows
    .filter((row) => row.special === null && !row.attributes.some((a) => /'hide'/.test(a.text)))
    .map((row) => ({
      name: row.name.text,
      insert: prefix + row.name.text,
      detail: [model.blocks[row.block]?.scope, row.type?.text].filter(Boolean).join(' · '),
      comment: joinComments(row.comments.map((cell) => cell.text)),
      group,
      category: 'variables',
    }));
}

/** Whether the variables of a list may be written without its name (GVL-06). */
export function isQualifiedOnly(declaration: string): boolean {
  return /\{\s*attribute\s+'qualified_only'/i.test(declaration);
}

/** A kind as the tree abbreviates it. */
function kindName(named: string): string {
  const { kind, subkind } = kindOfSubkind(named);
  return (subkind !== null && kindOf(kind)?.subkinds?.[subkind]?.short) || named.toUpperCase();
}

/** Types and POUs of the project. A function block is both: it is called, and it is the type of instances. */
export function objectEntries(objects: readonly ObjectSummary[], group: string): Entry[] {
  return objects.flatMap((object) => {
    const category = kindOf(object.kind)?.catalog;
    if (category === undefined) return [];
    const entry: Entry = {
      name: object.name,
      insert: object.name,
      detail: kindName(object.subkind ?? object.kind),
      comment: '',
      group,
      category,
    };
    return valuesOf(object) === 'instance' ? [entry, { ...entry, category: 'types' as const }] : [entry];
  });
}

/** A library as a reference shows it: under the namespace and with the access of the reference. */
export function asReferenced(library: Library, reference: LibraryReference | undefined): Library {
  return {
    ...library,
    namespace: reference?.namespace || library.namespace,
    qualified_only: library.qualified_only || (reference?.qualified_only ?? false),
  };
}

export function libraryEntries(library: Library): Entry[] {
  const prefix = library.qualified_only ? `${library.namespace}.` : '';
  return library.items.flatMap((item) => {
    const entry = (category: Category): Entry => ({
      name: item.name,
      insert: prefix + item.name,
      detail: kindName(item.kind),
      comment: item.summary,
      group: library.name,
      category,
    });
    const { kind, subkind } = kindOfSubkind(item.kind);
    const values = valuesOf({ kind, subkind });
    if (values === 'global')
      return item.members.map((pin) => ({
        ...entry('variables'),
        name: pin.name,
        insert: `${prefix}${item.name}.${pin.name}`,
        detail: pin.type,
        comment: pin.comment,
      }));
    const category = kindOf(kind)?.catalog;
    if (category === undefined) return [];
    return values === 'instance' ? [entry(category), entry('types')] : [entry(category)];
  });
}

/** Elementary types, keywords and operators of the language itself. */
export function languageEntries(groups: {
  types: string;
  keywords: string;
  operators: string;
  functions: string;
}): Entry[] {
  const make = (names: readonly string[], category: Category, group: string): Entry[] =>
    names.map((name) => ({ name, insert: name, detail: '', comment: '', group, category }));
  const conversions = [...NUMERIC_TYPES, 'TIME', 'STRING'];
  const converted = conversions.flatMap((from) =>
    conversions.filter((to) => to !== from).map((to) => `${from}_TO_${to}`),
  );
  return [
    ...make(ELEMENTARY_TYPES, 'types', groups.types),
    ...make([...STATEMENT_KEYWORDS, ...DECLARATION_KEYWORDS, ...CONSTANT_KEYWORDS], 'keywords', groups.keywords),
    ...make([...OPERATOR_KEYWORDS, ':=', '=>', 'REF=', 'S=', 'R=', '<>', '<=', '>='], 'keywords', groups.operators),
    ...make([...OPERATOR_FUNCTIONS, ...converted], 'keywords', groups.functions),
  ];
}

/** Entries of a category that fit what was typed: those that begin with it first, then those that hold it. */
export function search(entries: readonly Entry[], category: Category | null, typed: string): readonly Entry[] {
  const wanted = typed.trim().toUpperCase();
  const rank = (entry: Entry) => {
    const name = entry.name.toUpperCase();
    if (wanted === '') return 0;
    if (name.startsWith(wanted)) return 0;
    if (name.includes(wanted)) return 1;
    return entry.comment.toUpperCase().includes(wanted) || entry.group.toUpperCase() === wanted ? 2 : -1;
  };
  const twice = new Set(
    entries.filter((entry) => entry.category === 'pous').map((entry) => `${entry.group}.${entry.name}`),
  );
  // Among all, a function block stands once, although it is POU and type.
  const shown = (entry: Entry) =>
    category === null
      ? entry.category !== 'types' || !twice.has(`${entry.group}.${entry.name}`)
      : entry.category === category;
  return entries
    .filter(shown)
    .map((entry, at) => ({ entry, at, rank: rank(entry) }))
    .filter((found) => found.rank >= 0)
    .sort((a, b) => a.rank - b.rank || a.at - b.at)
    .map((found) => found.entry);
}

/** Libraries the project refers to; all installed ones where it has no library manager yet. */
export function referenced(
  references: readonly LibraryReference[] | null,
  installed: readonly string[],
): readonly string[] {
  if (references === null) return installed;
  const names = new Set(references.map((reference) => reference.name));
  return installed.filter((name) => names.has(name));
}
