import { describe, expect, it } from 'vitest';
import type { Library, LibraryItem, LibraryParameter, LibraryReference, LibrarySummary } from '@/api/types';
import { librariesInUse, parameterRows, withValue, type ParameterRow } from './parameters';

const list = (name: string, ...members: readonly [string, string, string][]): LibraryItem =>
  ({
    name,
    kind: 'parameter_list',
    members: members.map(([pin, type, value]) => ({ name: pin, type, default: value, comment: `about ${pin}` })),
  }) as unknown as LibraryItem;
const library = (name: string, ...items: LibraryItem[]): Library =>
  ({ name, version: '1.0', namespace: name, requires: [], replaces: [], items }) as unknown as Library;

const belts = library(
  'Belts',
  { name: 'Belt', kind: 'function_block', members: [] } as unknown as LibraryItem,
  list('GVL_Belt', ['cSlots', 'INT', '4'], ['cPause', 'TIME', 'T#5ms']),
  list('GVL_More', ['cSlots', 'INT', '9']),
);
const standard = library('Standard');
const installed = [belts, standard] as LibrarySummary[];
const contents = new Map([
  ['Belts 1.0', belts],
  ['Standard 1.0', standard],
]);
const uses = (...parameters: LibraryParameter[]): LibraryReference => ({
  name: 'Belts',
  version: '*',
  namespace: '',
  ...(parameters.length ? { parameters } : {}),
});
const rows = (...references: LibraryReference[]) => parameterRows(references, installed, contents);
const shown = (found: readonly ParameterRow[]) => found.map((row) => [row.list, row.name, row.value, row.known]);

describe('library parameters', () => {
  it('are those of all libraries in use, with their defaults', () => {
    const found = rows({ name: 'Standard', version: '*', namespace: '' }, uses());
    expect(shown(found)).toEqual([
      ['GVL_Belt', 'cSlots', null, true],
      ['GVL_Belt', 'cPause', null, true],
      ['GVL_More', 'cSlots', null, true],
    ]);
    expect(found[0]).toMatchObject({ at: 1, library: 'Belts', type: 'INT', default: '4', comment: 'about cSlots' });
    expect(new Set(found.map((row) => row.key)).size).toBe(3);
  });

  it('take values in any spelling, without a list the first of the name', () => {
    const twincat = uses({ list: 'GVL_MORE', name: 'CSLOTS', value: '20' });
    const codesys = uses({ list: '', name: 'CSLOTS', value: '30' });
    expect(rows(twincat).map((row) => row.value)).toEqual([null, null, '20']);
    expect(rows(codesys).map((row) => row.value)).toEqual(['30', null, null]);
  });

  it('show values that are for no parameter', () => {
    const value = { list: 'GVL_Belt', name: 'cGone', value: '1' };
    expect(shown(rows(uses(value))).at(-1)).toEqual(['GVL_Belt', 'cGone', '1', false]);
    expect(shown(parameterRows([uses(value)], [], contents))).toEqual([['GVL_Belt', 'cGone', '1', false]]);
    expect(shown(parameterRows([uses(value)], installed, new Map()))).toEqual([['GVL_Belt', 'cGone', '1', null]]);
  });

  it('get, change and lose a value', () => {
    const [slots, , more] = rows(uses());
    const one = withValue(uses(), slots!, '20');
    expect(one.parameters).toEqual([{ list: 'GVL_Belt', name: 'cSlots', value: '20' }]);
    const two = withValue(one, more!, '7');
    expect(rows(two).map((row) => row.value)).toEqual(['20', null, '7']);
    expect(withValue(two, slots!, '21').parameters).toEqual([
      { list: 'GVL_Belt', name: 'cSlots', value: '21' },
      { list: 'GVL_More', name: 'cSlots', value: '7' },
    ]);
    expect(withValue(withValue(two, slots!, null), more!, null)).toEqual(uses());
    expect(withValue(uses({ list: '', name: 'CSLOTS', value: '3' }), slots!, '4').parameters).toEqual([
      { list: 'GVL_Belt', name: 'cSlots', value: '4' },
    ]);
  });

  it('lose a value that is for no parameter, and keep the others', () => {
    const gone = uses({ list: '', name: 'cGone', value: '1' }, { list: 'GVL_Belt', name: 'cSlots', value: '20' });
    const row = rows(gone).find((each) => each.known === false)!;
    expect(withValue(gone, row, null)).toEqual(uses({ list: 'GVL_Belt', name: 'cSlots', value: '20' }));
  });

  it('are asked for once for each library', () => {
    const twice = [uses(), { ...uses(), namespace: 'B2' }, { name: 'Gone', version: '*', namespace: '' }];
    expect(librariesInUse(twice, installed).map(({ name }) => name)).toEqual(['Belts']);
  });
});
