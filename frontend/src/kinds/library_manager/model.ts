/** The references of a library manager as data. Pure functions. */
import type { LibraryReference, LibrarySummary } from '@/api/types';
import type { TextKey } from '@/i18n';
import { compareVersions } from '@/workbench/libraries/model';

/** The installed versions of a library, newest first; also found by a library of another system it stands for. */
export function versionsOf(name: string, installed: readonly LibrarySummary[]): LibrarySummary[] {
  const key = name.toUpperCase();
  const named = installed.filter((library) => library.name.toUpperCase() === key);
  const found = named.length
    ? named
    : installed.filter((library) => library.replaces.some((other) => other.toUpperCase() === key));
  return found.sort((a, b) => compareVersions(b.version, a.version));
}

/** The library that a reference means; null when it is not installed. The newest wins where `*` is asked for. */
export function libraryOf(
  reference: { name: string; version: string },
  installed: readonly LibrarySummary[],
): LibrarySummary | null {
  const versions = versionsOf(reference.name, installed);
  if (reference.version === '*') return versions[0] ?? null;
  return versions.find((library) => library.version === reference.version) ?? null;
}

/** The prefix that names of the library have in code. */
export function namespaceOf(reference: LibraryReference, installed: readonly LibrarySummary[]): string {
  if (reference.namespace) return reference.namespace;
  const library = versionsOf(reference.name, installed)[0];
  const name = reference.placeholder ?? reference.name;
  if (library && library.name.toUpperCase() === name.toUpperCase()) return library.namespace;
  return name;
}

/** What is wrong with a namespace, or null. */
export function namespaceFault(
  reference: LibraryReference,
  at: number,
  references: readonly LibraryReference[],
  installed: readonly LibrarySummary[],
): TextKey | null {
  const namespace = namespaceOf(reference, installed);
  if (reference.namespace && !/^[A-Za-z_][A-Za-z0-9_]*$/.test(reference.namespace)) return 'library.namespaceFault';
  const taken = references.some(
    (other, index) => index !== at && namespaceOf(other, installed).toUpperCase() === namespace.toUpperCase(),
  );
  return taken ? 'library.namespaceTaken' : null;
}

/** A row of the table: a reference, or a library that comes along because another one needs it (LIB-05). */
export interface ReferenceRow {
  key: string;
  level: number;
  name: string;
  /** What is asked for: a version or `*`. */
  version: string;
  library: LibrarySummary | null;
  /** Index among the references; null for what comes along. */
  at: number | null;
  reference: LibraryReference | null;
  expandable: boolean;
}

/** Whether names of the library are used behind the namespace only. */
export function isQualifiedOnly({ library, reference }: ReferenceRow): boolean {
  return (library?.qualified_only ?? false) || (reference?.qualified_only ?? false);
}

const DEEPEST = 20;

/** Rows for the references and, below those that are open, for what they need. */
export function rowsOf(
  references: readonly LibraryReference[],
  installed: readonly LibrarySummary[],
  open: ReadonlySet<string>,
): ReferenceRow[] {
  const rows: ReferenceRow[] = [];
  const needs = (library: LibrarySummary | null, parent: string, level: number) => {
    if (!library || level > DEEPEST || !open.has(parent)) return;
    for (const required of library.requires) {
      const resolved = references.find((one) => one.placeholder?.toUpperCase() === required.name.toUpperCase());
      const sameName = references.find((one) => one.name.toUpperCase() === required.name.toUpperCase());
      const wanted = resolved ?? (required.version === '*' && sameName ? sameName : required);
      const found = libraryOf(wanted, installed);
      const key = `${parent}/${required.name}`;
      rows.push({
        key,
        level,
        name: required.name,
        version: required.version,
        library: found,
        at: null,
        reference: null,
        expandable: (found?.requires.length ?? 0) > 0,
      });
      needs(found, key, level + 1);
    }
  };
  references.forEach((reference, at) => {
    const library = libraryOf(reference, installed);
    const key = keyOf(reference, installed);
    rows.push({
      key,
      level: 1,
      name: reference.name,
      version: reference.version,
      library,
      at,
      reference,
      expandable: (library?.requires.length ?? 0) > 0,
    });
    needs(library, key, 2);
  });
  return rows;
}

/** What identifies a reference: no two have one namespace. */
export function keyOf(reference: LibraryReference, installed: readonly LibrarySummary[]): string {
  return `${reference.name} ${reference.version} ${namespaceOf(reference, installed)}`;
}

/** Installed libraries, each once with its newest version. */
export function newestOf(installed: readonly LibrarySummary[]): LibrarySummary[] {
  const newest = new Map<string, LibrarySummary>();
  for (const library of installed) {
    const known = newest.get(library.name);
    if (!known || compareVersions(known.version, library.version) < 0) newest.set(library.name, library);
  }
  return [...newest.values()].sort((a, b) => a.name.localeCompare(b.name));
}

/** A reference to a library under a namespace that is free. */
export function freshReference(
  library: LibrarySummary,
  references: readonly LibraryReference[],
  installed: readonly LibrarySummary[],
): LibraryReference {
  const plain: LibraryReference = { name: library.name, version: '*', namespace: '' };
  if (!namespaceFault(plain, -1, references, installed)) return plain;
  const named = (count: number) => ({ ...plain, namespace: `${library.namespace}${count}` });
  let count = 2;
  while (namespaceFault(named(count), -1, references, installed)) count++;
  return named(count);
}
