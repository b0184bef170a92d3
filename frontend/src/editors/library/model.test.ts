import { describe, expect, it } from 'vitest';
import type { LibraryReference, LibrarySummary } from '@/api/types';
import { addable, compareVersions, effectiveVersion, namespaceFault, namespaceOf } from './model';

const installed = [
  ['Standard', '3.5.9.0'],
  ['Standard', '3.5.10.0'],
  ['Util', '1.0'],
].map(([name, version]) => ({ name, version, namespace: name === 'Util' ? 'UTIL' : name }) as LibrarySummary);
const reference = (name: string, version = '*', namespace = ''): LibraryReference => ({ name, version, namespace });

describe('library references', () => {
  it('take the newest version where any will do', () => {
    expect(effectiveVersion(reference('Standard'), installed)).toBe('3.5.10.0');
    expect(effectiveVersion(reference('Standard', '3.5.9.0'), installed)).toBe('3.5.9.0');
    expect(effectiveVersion(reference('Standard', '4'), installed)).toBeNull();
    expect(effectiveVersion(reference('Gone'), installed)).toBeNull();
    expect(compareVersions('3.5', '3.5.0')).toBe(0);
  });

  it('have a namespace of their own or the library', () => {
    expect(namespaceOf(reference('Util'), installed)).toBe('UTIL');
    expect(namespaceOf(reference('Util', '*', 'U'), installed)).toBe('U');
  });

  it('do not share a namespace', () => {
    const references = [reference('Standard'), reference('Util')];
    expect(namespaceFault('util', 0, references, installed)).toBe('library.namespaceTaken');
    expect(namespaceFault('2x', 0, references, installed)).toBe('library.namespaceFault');
    expect(namespaceFault('', 0, references, installed)).toBeNull();
    expect(namespaceFault('Util', 1, references, installed)).toBeNull();
  });

  it('offer what is not there yet, once', () => {
    expect(addable([reference('util')], installed).map((library) => library.version)).toEqual(['3.5.10.0']);
  });
});
