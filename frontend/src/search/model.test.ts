import { describe, expect, it } from 'vitest';
import {
  AREAS,
  changedSince,
  choiceOf,
  orderOf,
  replaceOrderOf,
  rowsOf,
  withChoice,
  type SearchForm,
  type SearchHit,
  type SearchObject,
} from './model';

const FORM: SearchForm = {
  text: 'speed',
  replacement: 'velocity',
  replacing: true,
  matchCase: false,
  wholeWords: true,
  regularExpression: false,
  areas: AREAS,
  scope: 'project',
};
const OBJECTS = { applicationId: 'app', selection: ['a', 'b'], editors: ['c'] };

const hit = (number: number, writable = true): SearchHit => ({
  number,
  area: 'implementations',
  part: 'implementation',
  element: null,
  field: '',
  line: number + 1,
  column: 1,
  end_line: number + 1,
  end_column: 6,
  before: '',
  match: 'speed',
  after: ' := 1;',
  replacement: writable ? 'velocity' : null,
  writable,
});
const group = (id: string, ...hits: SearchHit[]): SearchObject => ({
  object_id: id,
  library: null,
  name: id,
  path: `Application/${id}`,
  kind: 'pou',
  subkind: 'program',
  revision: 3,
  hits,
  total: hits.length,
});

describe('orderOf', () => {
  it('names the objects of each scope', () => {
    const within = (scope: SearchForm['scope']) => orderOf({ ...FORM, scope }, OBJECTS, null)?.within;
    expect(within('project')).toBeNull();
    expect(within('active')).toEqual(['app']);
    expect(within('selection')).toEqual(['a', 'b']);
    expect(within('editors')).toEqual(['c']);
    expect(orderOf({ ...FORM, scope: 'editors' }, OBJECTS, null)?.children).toBe(false);
  });

  it('asks for nothing without text, parts or objects', () => {
    expect(orderOf({ ...FORM, text: '' }, OBJECTS, null)).toBeNull();
    expect(orderOf({ ...FORM, areas: [] }, OBJECTS, null)).toBeNull();
    expect(orderOf({ ...FORM, scope: 'editors' }, { ...OBJECTS, editors: [] }, null)).toBeNull();
  });

  it('asks for a preview only where something can be replaced', () => {
    expect(orderOf(FORM, OBJECTS, null)?.replacement).toBe('velocity');
    expect(orderOf({ ...FORM, replacing: false }, OBJECTS, null)?.replacement).toBeNull();
    expect(orderOf({ ...FORM, scope: 'libraries' }, OBJECTS, null)?.replacement).toBeNull();
  });
});

describe('results', () => {
  const groups = [group('a', hit(0), hit(1)), group('b', hit(0, false))];

  it('are rows of objects and their hits', () => {
    expect(rowsOf(groups, new Set()).map((row) => row.object.id)).toEqual(['a', 'a#0', 'a#1', 'b', 'b#0']);
    expect(rowsOf(groups, new Set(['a'])).map((row) => row.object.id)).toEqual(['a', 'b', 'b#0']);
  });

  it('can be left out one by one or by object', () => {
    const rows = rowsOf(groups, new Set());
    const one = withChoice(rows[1]!, new Set());
    expect(choiceOf(groups[0]!, one)).toBe('some');
    const all = withChoice(rows[0]!, one);
    expect(choiceOf(groups[0]!, all)).toBe(true);
    expect(choiceOf(groups[0]!, withChoice(rows[0]!, all))).toBe(false);
    expect(choiceOf(groups[1]!, new Set())).toBeNull();
  });

  it('are replaced on top of the revision that was searched', () => {
    expect(replaceOrderOf(FORM, groups, new Set(['a#0']))?.objects).toEqual([
      { object_id: 'a', base_revision: 3, hits: [1] },
    ]);
    expect(replaceOrderOf(FORM, groups, new Set(['a#0', 'a#1']))).toBeNull();
  });

  it('are old when an object has another revision or is gone', () => {
    const summary = {
      id: 'a',
      parent_id: null,
      kind: 'pou',
      subkind: null,
      name: 'a',
      index: 0,
      revision: 3,
      excluded: false,
    };
    expect(changedSince([groups[0]!], [summary])).toBe(false);
    expect(changedSince([groups[0]!], [{ ...summary, revision: 4 }])).toBe(true);
    expect(changedSince([groups[0]!], [])).toBe(true);
  });
});
