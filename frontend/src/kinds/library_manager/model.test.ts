import { describe, expect, it } from 'vitest';
import type { LibraryReference, LibrarySummary } from '@/api/types';
import {
  freshReference,
  isQualifiedOnly,
  libraryOf,
  namespaceFault,
  namespaceOf,
  newestOf,
  rowsOf,
  versionsOf,
} from './model';

const installed = [
  ['Standard', '3.5.9.0'],
  ['Standard', '3.5.10.0'],
  ['Util', '1.0'],
  ['Drives', '2.0'],
].map(
  ([name, version]) =>
    ({
      name,
      version,
      namespace: name === 'Util' ? 'UTIL' : name,
      requires:
        name === 'Drives'
          ? [
              { name: 'Util', version: '*', namespace: '' },
              { name: 'Standard', version: '3.5.9.0', namespace: '' },
            ]
          : name === 'Util'
            ? [{ name: 'Basics', version: '*', namespace: '' }]
            : [],
      replaces: name === 'Standard' ? ['Tc2_Standard'] : [],
    }) as unknown as LibrarySummary,
);
const reference = (name: string, version = '*', namespace = '', placeholder?: string): LibraryReference => ({
  name,
  version,
  namespace,
  placeholder,
});

describe('library references', () => {
  it('take the newest version where any will do', () => {
    expect(libraryOf(reference('Standard'), installed)?.version).toBe('3.5.10.0');
    expect(libraryOf(reference('Standard', '3.5.9.0'), installed)?.version).toBe('3.5.9.0');
    expect(libraryOf(reference('Tc2_Standard'), installed)?.name).toBe('Standard');
    expect(libraryOf(reference('Standard', '4'), installed)).toBeNull();
    expect(libraryOf(reference('Gone'), installed)).toBeNull();
    expect(versionsOf('standard', installed).map((library) => library.version)).toEqual(['3.5.10.0', '3.5.9.0']);
  });

  it('have a namespace of their own, of the placeholder or of the library', () => {
    expect(namespaceOf(reference('Util'), installed)).toBe('UTIL');
    expect(namespaceOf(reference('Util', '*', 'U'), installed)).toBe('U');
    expect(namespaceOf(reference('Util', '*', '', 'Tools'), installed)).toBe('Tools');
    expect(namespaceOf(reference('Util', '*', '', 'Util'), installed)).toBe('UTIL');
  });

  it('do not share a namespace', () => {
    const references = [reference('Standard'), reference('Util')];
    expect(namespaceFault(reference('Standard', '*', 'util'), 0, references, installed)).toBe('library.namespaceTaken');
    expect(namespaceFault(reference('Standard', '*', '2x'), 0, references, installed)).toBe('library.namespaceFault');
    expect(namespaceFault(reference('Standard'), 0, references, installed)).toBeNull();
    expect(namespaceFault(reference('Standard', '3.5.9.0'), -1, references, installed)).toBe('library.namespaceTaken');
    expect(freshReference(installed[0]!, references, installed).namespace).toBe('Standard2');
    expect(freshReference(installed[3]!, references, installed).namespace).toBe('');
  });

  it('show what a library brings along, in the version that is used', () => {
    const references = [reference('Drives'), reference('Util'), reference('Standard', '*', '', 'Basics')];
    const closed = rowsOf(references, installed, new Set());
    expect(closed.map((row) => [row.name, row.level, row.expandable])).toEqual([
      ['Drives', 1, true],
      ['Util', 1, true],
      ['Standard', 1, false],
    ]);
    const drives = closed[0]!.key;
    const open = rowsOf(references, installed, new Set([drives, `${drives}/Util`]));
    expect(open.slice(0, 4).map((row) => [row.name, row.level, row.library?.version ?? null])).toEqual([
      ['Drives', 1, '2.0'],
      ['Util', 2, '1.0'],
      ['Basics', 3, '3.5.10.0'],
      ['Standard', 2, '3.5.9.0'],
    ]);
  });

  it('offer each library once', () => {
    expect(newestOf(installed).map((library) => `${library.name} ${library.version}`)).toEqual([
      'Drives 2.0',
      'Standard 3.5.10.0',
      'Util 1.0',
    ]);
  });

  it('show which names need the namespace, by the library or by the reference', () => {
    const library = { ...installed[2]!, qualified_only: true };
    const [plain, asked] = rowsOf(
      [reference('Util'), { ...reference('Util', '*', 'U2'), qualified_only: true }],
      installed,
      new Set(),
    );
    expect([isQualifiedOnly(plain!), isQualifiedOnly(asked!)]).toEqual([false, true]);
    expect(isQualifiedOnly(rowsOf([reference('Util')], [library], new Set())[0]!)).toBe(true);
  });
});
