import { describe, expect, it } from 'vitest';
import { declaredAt, effectCounts, hiddenAtFirst, shownChanges, typeText, type ChangedVariable } from './changes';

const row = (path: string, effect: ChangedVariable['effect'], type = 'INT', before = ''): ChangedVariable => ({
  path,
  effect,
  reason: 'new',
  type,
  before,
  calls: [],
  remanent: false,
});
const rows = [row('PLC_PRG.nNew', 'initialised'), row('PLC_PRG.a', 'moved'), row('GVL.s', 'lost', 'STRING(80)')];

describe('changes of variables', () => {
  it('are counted by what happens', () => {
    expect(effectCounts(rows)).toEqual({
      lost: 1,
      cleared: 0,
      initialised: 1,
      converted: 0,
      kept: 0,
      follows: 0,
      moved: 1,
    });
  });

  it('hide what merely moves, unless nothing else happens', () => {
    expect(hiddenAtFirst(rows)).toEqual(new Set(['moved']));
    expect(hiddenAtFirst([row('x', 'moved')])).toEqual(new Set());
    expect(hiddenAtFirst([row('x', 'moved'), row('p', 'follows')])).toEqual(new Set());
    expect(hiddenAtFirst([...rows, row('p', 'follows')])).toEqual(new Set(['moved', 'follows']));
    expect(hiddenAtFirst([row('x', 'moved'), row('p', 'cleared')])).toEqual(new Set(['moved']));
  });

  it('are found by path and type, whatever the case', () => {
    expect(shownChanges(rows, new Set(), 'NNEW')).toEqual([rows[0]]);
    expect(shownChanges(rows, new Set(), 'string')).toEqual([rows[2]]);
    expect(shownChanges(rows, new Set(['lost', 'moved']), '')).toEqual([rows[0]]);
  });

  it('lead to one declaration', () => {
    expect(declaredAt('PLC_PRG.row[1..3, -2..4].x')).toBe('PLC_PRG.row[1, -2].x');
  });

  it('show both types where they differ', () => {
    expect(typeText(row('x', 'converted', 'DINT', 'INT'))).toBe('INT → DINT');
    expect(typeText(row('x', 'moved', 'DINT'))).toBe('DINT');
  });
});
