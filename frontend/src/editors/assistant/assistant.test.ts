import { describe, expect, it } from 'vitest';
import type { Library, ObjectSummary } from '@/api/types';
import {
  asReferenced,
  isQualifiedOnly,
  languageEntries,
  libraryEntries,
  objectEntries,
  referenced,
  search,
  variableEntries,
} from './catalog';

const object = (name: string, kind: string, subkind: string | null) =>
  ({ id: name, name, kind, subkind }) as ObjectSummary;
const library: Library = {
  name: 'Standard',
  version: '1',
  namespace: 'Standard',
  company: '',
  description: '',
  removable: false,
  requires: [],
  replaces: [],
  qualified_only: false,
  items: ['TON', 'LEN'].map((name) => ({
    name,
    kind: name === 'TON' ? 'function_block' : 'function',
    summary: name === 'TON' ? 'on-delay timer' : '',
    inputs: [],
    outputs: [],
    in_out: [],
    members: [],
    methods: [],
    values: [],
    returns: null,
  })),
};

describe('input assistant', () => {
  it('lists variables with type and comment, hidden ones left out', () => {
    const text = "VAR_GLOBAL\n  x : INT; // speed\n  {attribute 'hide'}\n  y : INT;\nEND_VAR";
    expect(variableEntries(text, 'GVL', 'GVL.')).toEqual([
      { name: 'x', insert: 'GVL.x', detail: 'VAR_GLOBAL · INT', comment: 'speed', group: 'GVL', category: 'variables' },
    ]);
    expect(isQualifiedOnly("{attribute 'qualified_only'}\nVAR_GLOBAL")).toBe(true);
    expect(isQualifiedOnly('VAR_GLOBAL')).toBe(false);
  });

  it('offers function blocks as POU and as type, and once among all', () => {
    const entries = [
      ...objectEntries([object('FB_A', 'pou', 'function_block'), object('ST_A', 'dut', 'struct')], 'Project'),
      ...libraryEntries(library),
    ];
    const names = (category: 'pous' | 'types' | null, typed = '') =>
      search(entries, category, typed).map((e) => e.name);
    expect(names('types')).toEqual(['FB_A', 'ST_A', 'TON']);
    expect(names('pous')).toEqual(['FB_A', 'TON', 'LEN']);
    expect(names(null)).toEqual(['FB_A', 'ST_A', 'TON', 'LEN']);
    expect(names(null, 'n')).toEqual(['TON', 'LEN']);
    expect(names(null, 'delay')).toEqual(['TON']);
    expect(names(null, 'fb')).toEqual(['FB_A']);
  });

  it('offers the parameters of a library as its constants', () => {
    const pin = { name: 'cSlots', type: 'INT', default: '4', comment: 'places' };
    const list = { ...library.items[0]!, name: 'GVL_Belt', kind: 'parameter_list', members: [pin] };
    const entries = libraryEntries({ ...library, items: [list] });
    expect(entries.map(({ insert, detail, category }) => [insert, detail, category])).toEqual([
      ['GVL_Belt.cSlots', 'INT', 'variables'],
    ]);
  });

  it('puts the namespace in front where the library or its reference asks for it', () => {
    const inserts = (detail: Library) => libraryEntries(detail).map((entry) => entry.insert);
    const reference = { name: 'Standard', version: '*', namespace: 'Std' };
    expect(inserts(asReferenced(library, reference))).toEqual(['TON', 'TON', 'LEN']);
    expect(inserts(asReferenced(library, { ...reference, qualified_only: true }))).toEqual([
      'Std.TON',
      'Std.TON',
      'Std.LEN',
    ]);
    expect(inserts(asReferenced({ ...library, qualified_only: true }, undefined))[0]).toBe('Standard.TON');
  });

  it('knows the language and the libraries of the project', () => {
    const entries = languageEntries({ types: 't', keywords: 'k', operators: 'o', functions: 'f' });
    expect(search(entries, 'keywords', 'END_C').map((e) => e.name)).toEqual(['END_CASE']);
    expect(search(entries, 'types', 'LRE').map((e) => e.name)).toEqual(['LREAL']);
    expect(search(entries, 'keywords', 'INT_TO_RE')[0]?.name).toBe('INT_TO_REAL');
    expect(referenced(null, ['A', 'B'])).toEqual(['A', 'B']);
    expect(referenced([{ name: 'B', version: '*', namespace: 'B' }], ['A', 'B'])).toEqual(['B']);
  });
});
