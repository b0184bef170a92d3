import { describe, expect, it } from 'vitest';
import type { ObjectSummary } from '@/api/types';
import type { SubscribedItem } from '@/online/item';
import { monitorTarget } from '@/project/monitorScope';
import { pillOf, PillWidths, type PillState } from './pills';
import { expressionOf } from '@/iec/variables';
import { unchangedLines } from './staleLines';
import { usesOf } from './uses';

const object = (id: string, kind: string, parent: string | null, subkind: string | null = null) =>
  ({ id, kind, parent_id: parent, subkind, name: id, index: 0, revision: 1 }) as ObjectSummary;

const objects = [
  object('App', 'application', null),
  object('PLC_PRG', 'pou', 'App', 'program'),
  object('FB', 'pou', 'App', 'function_block'),
  object('Start', 'method', 'FB'),
  object('Act', 'action', 'PLC_PRG'),
  object('F', 'pou', 'App', 'function'),
  object('GVL', 'gvl', 'App'),
];
const of = (id: string, instance: string | null = null, declaration = '') => {
  const found = objects.find((o) => o.id === id);
  if (found === undefined) throw new Error(id);
  const { path, needsInstanceOf, temporary } = monitorTarget(objects, found, instance, declaration);
  return { path, needsInstanceOf, temporary: [...temporary] };
};

describe('what an editor shows online', () => {
  it('is fixed for programs, their actions and lists', () => {
    expect(of('PLC_PRG', null, 'PROGRAM PLC_PRG\nVAR_TEMP\n t : INT;\nEND_VAR')).toEqual({
      path: 'PLC_PRG',
      needsInstanceOf: null,
      temporary: ['T'],
    });
    expect(of('Act').path).toBe('PLC_PRG');
    expect(of('GVL').path).toBe('GVL');
  });
  it('has to be chosen for function blocks and their methods', () => {
    expect(of('FB')).toMatchObject({ path: null, needsInstanceOf: 'FB' });
    expect(of('FB', 'PLC_PRG.fb1')).toMatchObject({ path: 'PLC_PRG.fb1', needsInstanceOf: null });
    const start = of(
      'Start',
      'PLC_PRG.fb1',
      'METHOD Start : BOOL\nVAR_INPUT\n n : INT;\nEND_VAR\nVAR_STAT\n k : INT;\nEND_VAR',
    );
    expect(start).toEqual({ path: 'PLC_PRG.fb1', needsInstanceOf: null, temporary: ['N', 'START'] });
  });
  it('is nothing for functions', () => {
    expect(of('F', null, 'FUNCTION F : INT\nVAR\n i : INT;\nEND_VAR')).toEqual({
      path: null,
      needsInstanceOf: null,
      temporary: ['I', 'F'],
    });
  });
});

describe('pills', () => {
  const item: SubscribedItem = { expression: 'x', offset: 0, size: 2, type: 'INT', kind: 'int' };
  const state = (value: number | boolean | null, more: Partial<PillState> = {}): PillState => ({
    live: {
      item: typeof value === 'boolean' ? { ...item, kind: 'bool', type: 'BOOL', size: 1 } : item,
      value,
      changedAt: 0,
    },
    executed: null,
    forced: false,
    prepared: null,
    lost: false,
    stale: false,
    now: 10_000,
    format: 'dec',
    ...more,
  });
  it('show value, force and prepared value', () => {
    expect(pillOf(state(42), 4)).toEqual({ text: '\u00a0\u00a042', classes: ['pill'], prepared: null });
    expect(pillOf(state(true, { forced: true, prepared: 'FALSE' }), 5)).toEqual({
      text: 'F\u00a0TRUE\u00a0',
      classes: ['pill', 'true', 'forced'],
      prepared: '<FALSE>',
    });
  });
  it('show what a statement left, in the number format of the view', () => {
    expect(pillOf(state(42, { executed: '17' }), 4)).toEqual({
      text: '\u00a0\u00a017',
      classes: ['pill', 'executed'],
      prepared: null,
    });
    expect(pillOf(state(42, { executed: '17', format: 'hex' }), 0)?.text).toBe('16#0011');
    expect(pillOf(state(false, { executed: 'TRUE' }), 5)?.classes).toEqual(['pill', 'executed', 'true']);
    expect(pillOf({ ...state(null), live: null, executed: 'Starting' }, 0)?.text).toBe('Starting');
  });
  it('mark what changed just now, unless the connection is lost', () => {
    const fresh = state(1);
    const changed = { ...fresh, live: { item, value: 1, changedAt: 9500 } };
    expect(pillOf(changed, 0)?.classes).toContain('fresh');
    expect(pillOf({ ...changed, lost: true }, 0)?.classes).toEqual(['pill', 'lost']);
    expect(pillOf({ ...changed, now: 10_600, stale: true }, 0)?.classes).toEqual(['pill', 'stale']);
  });
  it('are not shown without a value', () => {
    expect(pillOf(state(null), 0)).toBeNull();
    expect(pillOf({ ...state(1), live: null }, 0)).toBeNull();
    expect(
      pillOf({ ...state(1), live: { item: { ...item, kind: 'fb', size: 0 }, value: null, changedAt: 0 } }, 0),
    ).toBeNull();
  });
  it('keep the width of the widest value seen', () => {
    const widths = new PillWidths();
    const live = (value: number) => ({ item, value, changedAt: 0 });
    expect(widths.widthOf('x', live(12345), 'dec')).toBe(5);
    expect(widths.widthOf('x', live(1), 'dec')).toBe(5);
    expect(widths.widthOf('y', live(1), 'dec')).toBe(1);
  });
});

describe('lines that run', () => {
  const marks = (running: string, now: string) =>
    unchangedLines(running.replaceAll('|', '\n'), now.replaceAll('|', '\n'));
  it.each([
    ['a|b|c', 'a|b|c', [true, true, true]],
    ['a|b|c', 'a|x|c', [true, false, true]],
    ['a|b|c', 'a|n|b|c', [true, false, true, true]],
    ['a|b|c|d', 'a|c|new|d', [true, true, false, true]],
    ['a|b', '  a|b ', [true, true]],
    ['', 'a', [false]],
  ])('%s -> %s', (running, now, expected) => expect(marks(running, now)).toEqual(expected));
});

describe('values in a declaration', () => {
  const expressions = (text: string, members: readonly string[]) => {
    const scope = { instance: 'PLC_PRG', members: new Set(members), temporary: new Set(['T']) };
    return usesOf
      .declaration(text)
      .map(({ start, end, path }) => [text.slice(start, end), expressionOf(path, scope, () => null)]);
  };
  it('stand behind each name that has a place in the running program', () => {
    const text =
      'PROGRAM PLC_PRG\nVAR // a : INT\n a, b : INT := limit;\n new : INT;\nEND_VAR\n' +
      'VAR_TEMP\n t : INT;\nEND_VAR\nVAR_EXTERNAL\n g : INT;\nEND_VAR';
    expect(expressions(text, ['A', 'B'])).toEqual([
      ['a', 'PLC_PRG.a'],
      ['b', 'PLC_PRG.b'],
      // Loaded later: another variable of that name would be shown otherwise.
      ['new', null],
      ['t', null],
      ['g', 'g'],
    ]);
  });
  it('are none of a structure or an enumeration', () => {
    expect(expressions('TYPE S :\nSTRUCT\n a : INT;\nEND_STRUCT\nEND_TYPE', ['A'])).toEqual([]);
    expect(expressions('TYPE E : (a, b);\nEND_TYPE', ['A'])).toEqual([]);
  });
});
