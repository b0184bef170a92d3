/** The references of a library manager as data. Pure functions. */
import type { LibraryReference, LibrarySummary } from '@/api/types';
import type { TextKey } from '@/i18n';

/** The newest version wins where `*` is asked for. Versions compare number by number. */
export function effectiveVersion(reference: LibraryReference, installed: readonly LibrarySummary[]): string | null {
  const versions = installed.filter((library) => library.name === reference.name).map((library) => library.version);
  if (reference.version !== '*') return versions.includes(reference.version) ? reference.version : null;
  return versions.sort(compareVersions).at(-1) ?? null;
}

export function compareVersions(a: string, b: string): number {
  const left = a.split('.').map(Number);
  const right = b.split('.').map(Number);
  for (let at = 0; at < Math.max(left.length, right.length); at++) {
    const difference = (left[at] ?? 0) - (right[at] ?? 0);
    if (difference) return difference;
  }
  return 0;
}

/** The prefix that names of the library have in code. */
export function namespaceOf(reference: LibraryReference, installed: readonly LibrarySummary[]): string {
  if (reference.namespace) return reference.namespace;
  return installed.find((library) => library.name === reference.name)?.namespace ?? reference.name;
}

/** What is wrong with a namespace, or null. */
export function namespaceFault(
  namespace: string,
  at: number,
  references: readonly LibraryReference[],
  installed: readonly LibrarySummary[],
): TextKey | null {
  if (namespace === '') return null;
  if (!/^[A-Za-z_][A-Za-z0-9_]*$/.test(namespace)) return 'library.namespaceFault';
  const taken = references.some(
    (other, index) => index !== at && namespaceOf(other, installed).toUpperCase() === namespace.toUpperCase(),
  );
  return taken ? 'library.namespaceTaken' : null;
}

/** Installed libraries that are not referenced yet (LIB-09), each once with its newest version. */
export function addable(
  references: readonly LibraryReference[],
  installed: readonly LibrarySummary[],
): LibrarySummary[] {
  const taken = new Set(references.map((reference) => reference.name.toUpperCase()));
  const newest = new Map<string, LibrarySummary>();
  for (const library of installed) {
    if (taken.has(library.name.toUpperCase())) continue;
    const known = newest.get(library.name);
    if (!known || compareVersions(known.version, library.version) < 0) newest.set(library.name, library);
  }
  return [...newest.values()].sort((a, b) => a.name.localeCompare(b.name));
}
