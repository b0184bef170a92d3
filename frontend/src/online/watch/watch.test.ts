import { describe, expect, it } from 'vitest';
import type { ObjectSummary } from '@/api/types';
import { SymbolTree, type SymbolChild } from '../symbols';
import { flatten, watchedExpressions, type OnlineRoot } from '../treeRows';
import { completionsFor, isComplete, preselected, splitExpression } from './completion';
import {
  addToList,
  deleteList,
  findList,
  moveInList,
  newList,
  plainExpression,
  removeFromList,
  renameList,
  setExpression,
  setLineFormat,
  setListOptions,
  useWatchLists,
} from './lists';
import { freeName, nameFault } from './listTitle';
import { listsFrom, toStored } from './model';

const child = (path: string, type: string, kind: string, leaf: boolean): SymbolChild => ({
  name: path.endsWith(']') ? path.slice(path.lastIndexOf('[')) : path.slice(path.lastIndexOf('.') + 1),
  path,
  type,
  kind,
  leaf,
});

/** PLC_PRG with two fillers in an array and one beside, each with a timer; a GVL. */
function plant() {
  const asked: string[] = [];
  const source = (path: string): Promise<readonly SymbolChild[]> => {
    asked.push(path);
    const answer: Record<string, SymbolChild[]> = {
      '': [child('GVL', 'GVL', 'gvl', false), child('PLC_PRG', 'PLC_PRG', 'program', false)],
      GVL: [child('GVL.xGo', 'BOOL', 'bool', true)],
      PLC_PRG: [
        child('PLC_PRG.aFill', 'ARRAY [0..1] OF FB_Fill', 'array', false),
        child('PLC_PRG.fbFill', 'FB_Fill', 'fb', false),
        child('PLC_PRG.n', 'INT', 'int', true),
      ],
      'PLC_PRG.aFill': [
        child('PLC_PRG.aFill[0]', 'FB_Fill', 'fb', false),
        child('PLC_PRG.aFill[1]', 'FB_Fill', 'fb', false),
      ],
      'PLC_PRG.aFill[0]': [child('PLC_PRG.aFill[0].t', 'TON', 'fb', false)],
      'PLC_PRG.aFill[0].t': [child('PLC_PRG.aFill[0].t.Q', 'BOOL', 'bool', true)],
    };
    const found = answer[path];
    return found === undefined ? Promise.reject(new Error(path)) : Promise.resolve(found);
  };
  return { tree: new SymbolTree(source), asked };
}

describe('symbol tree', () => {
  it('asks for each type once and finds all instances', async () => {
    const { tree, asked } = plant();
    expect(await tree.instancesOf('fb_fill')).toEqual(['PLC_PRG.aFill[0]', 'PLC_PRG.aFill[1]', 'PLC_PRG.fbFill']);
    expect(await tree.instancesOf('TON')).toEqual(['PLC_PRG.aFill[0].t', 'PLC_PRG.aFill[1].t', 'PLC_PRG.fbFill.t']);
    expect(asked.sort()).toEqual(['', 'GVL', 'PLC_PRG', 'PLC_PRG.aFill', 'PLC_PRG.aFill[0]', 'PLC_PRG.aFill[0].t']);
    expect((await tree.children('PLC_PRG.fbFill.t')).map((c) => c.path)).toEqual(['PLC_PRG.fbFill.t.Q']);
    expect(await tree.children('PLC_PRG.n')).toEqual([]);
  });
});

describe('expression completion', () => {
  it('offers what continues the text', async () => {
    const { tree } = plant();
    const names = async (text: string) => (await completionsFor(tree, text)).map((c) => c.expression);
    expect(await names('')).toEqual(['GVL', 'PLC_PRG']);
    expect(await names('plc_prg.')).toEqual(['PLC_PRG.aFill', 'PLC_PRG.fbFill', 'PLC_PRG.n']);
    expect(await names('PLC_PRG.f')).toEqual(['PLC_PRG.fbFill']);
    expect(await names('PLC_PRG.aFill[1')).toEqual(['PLC_PRG.aFill[1]']);
    expect(await names('PLC_PRG.n')).toEqual([]);
  });
  it('is taken by Enter, unless the typed text is a variable itself or nothing is typed of its name', async () => {
    const { tree } = plant();
    const first = async (text: string) =>
      preselected(await completionsFor(tree, text), text, await isComplete(tree, text));
    expect(await first('PLC_PRG.f')).toBe(0);
    expect(await first('PLC_PRG.')).toBe(-1);
    expect(await first('')).toBe(-1);
    expect(await first('PLC_PRG.FBFILL')).toBe(-1);
    expect(preselected(await completionsFor(tree, 'PLC_PRG.f'), 'PLC_PRG.f', true)).toBe(-1);
  });
  it('knows where the name begins', () => {
    expect(splitExpression('a.b[1].c')).toEqual({ path: 'a.b[1]', start: 'c' });
    expect(splitExpression('a.b[1')).toEqual({ path: 'a.b', start: '[1' });
    expect(splitExpression('a')).toEqual({ path: '', start: 'a' });
  });
});

describe('rows of an online table', () => {
  const roots: OnlineRoot[] = [
    { key: 'r1', expression: 'PLC_PRG.fbFill', label: 'PLC_PRG.fbFill', kind: 'fb', leaf: false },
    { key: 'r2', expression: 'PLC_PRG.n', label: 'PLC_PRG.n', kind: 'int', leaf: true },
  ];
  const children = new Map([
    [
      'PLC_PRG.FBFILL',
      [child('PLC_PRG.fbFill.t', 'TON', 'fb', false), child('PLC_PRG.fbFill.x', 'BOOL', 'bool', true)],
    ],
  ]);
  it('show components of what is open', () => {
    expect(flatten(roots, new Set(), children).map((r) => r.key)).toEqual(['r1', 'r2']);
    const rows = flatten(roots, new Set(['r1']), children);
    expect(rows.map((r) => [r.depth, r.label, r.expression, r.open])).toEqual([
      [0, 'PLC_PRG.fbFill', 'PLC_PRG.fbFill', true],
      [1, 't', 'PLC_PRG.fbFill.t', false],
      [1, 'x', 'PLC_PRG.fbFill.x', undefined],
      [0, 'PLC_PRG.n', 'PLC_PRG.n', undefined],
    ]);
    expect(watchedExpressions(rows, 0, 10)).toEqual(['PLC_PRG.fbFill.x', 'PLC_PRG.n']);
    expect(watchedExpressions(rows, 3, 3)).toEqual(['PLC_PRG.n']);
  });
});

describe('watch lists', () => {
  const list = () => (findList('2')?.entries ?? []).map((entry) => entry.expression);
  const idOf = (expression: string) => findList('2')?.entries.find((e) => e.expression === expression)?.id ?? '';
  it('take, change, move and drop expressions', () => {
    addToList('2', ['PLC_PRG.a', ' PLC_PRG.b ', 'plc_prg.A', '']);
    expect(list()).toEqual(['PLC_PRG.a', 'PLC_PRG.b']);
    addToList('2', ['PLC_PRG.c'], idOf('PLC_PRG.b'));
    expect(list()).toEqual(['PLC_PRG.a', 'PLC_PRG.c', 'PLC_PRG.b']);
    setExpression('2', idOf('PLC_PRG.c'), 'PLC_PRG.d');
    moveInList('2', idOf('PLC_PRG.d'), -1);
    moveInList('2', idOf('PLC_PRG.d'), -1);
    expect(list()).toEqual(['PLC_PRG.d', 'PLC_PRG.a', 'PLC_PRG.b']);
    setExpression('2', idOf('PLC_PRG.a'), '  ');
    removeFromList('2', [idOf('PLC_PRG.b')]);
    expect(list()).toEqual(['PLC_PRG.d']);
    expect(toStored(useWatchLists.getState().lists)['2']).toEqual(['PLC_PRG.d']);
  });
  it("of one's own are made, copied, named and deleted; Watch 1 to 4 stay", () => {
    const names = () => useWatchLists.getState().lists.map(({ name }) => name);
    const mine = newList(' Pumps ');
    addToList(mine, ['GVL.xPump']);
    setListOptions(mine, { history: true });
    const copy = newList('Pumps 2', mine);
    renameList(mine, 'All pumps');
    renameList('1', 'First');
    addToList(copy, ['GVL.xValve']);
    expect(names()).toEqual([null, null, null, null, 'All pumps', 'Pumps 2']);
    expect(findList(mine)?.entries.map((e) => e.expression)).toEqual(['GVL.xPump']);
    expect(findList(copy)?.entries.map((e) => e.expression)).toEqual(['GVL.xPump', 'GVL.xValve']);
    expect(findList(copy)?.options.history).toBe(true);
    expect(useWatchLists.getState().current).toBe(copy);
    deleteList('1');
    deleteList(copy);
    expect(names()).toEqual([null, null, null, null, 'All pumps']);
    expect(useWatchLists.getState().current).toBe('1');
    deleteList(mine);
  });
  it('come back from the settings as they were, those of four lists too', () => {
    const mine = newList('Pumps');
    addToList(mine, ['GVL.a', 'GVL.b']);
    setLineFormat(mine, [findList(mine)?.entries[1]?.id ?? ''], 'hex');
    setListOptions(mine, { format: 'bin' });
    const stored: unknown = JSON.parse(JSON.stringify(toStored(useWatchLists.getState().lists)));
    expect(listsFrom(stored).at(-1)).toEqual({
      id: mine,
      name: 'Pumps',
      entries: [{ expression: 'GVL.a' }, { expression: 'GVL.b', format: 'hex' }],
      options: { format: 'bin', history: false },
    });
    deleteList(mine);
    const before = {
      1: ['A.b', { expression: 'A.c', format: 'hex' }],
      options: { 1: { format: null, history: true } },
    };
    expect(listsFrom(before).map(({ entries }) => entries.length)).toEqual([2, 0, 0, 0]);
    expect(listsFrom(before)[0]?.options).toEqual({ format: null, history: true });
    expect(listsFrom([3, 'x']).length).toBe(4);
    expect(listsFrom({ own: [{ id: 'own1' }, null, { id: '1', name: 'x' }] }).length).toBe(4);
  });
  it('have names that tell them apart', () => {
    expect(nameFault('  ', [])).toBe('empty');
    expect(nameFault('x'.repeat(61), [])).toBe('long');
    expect(nameFault('watch 1', ['Watch 1'])).toBe('taken');
    expect(freeName('Watch 1', ['Watch 1', 'Watch 1 2'])).toBe('Watch 1 3');
    expect(freeName('Mine', ['Watch 1'])).toBe('Mine');
  });
  it('accept full paths with device and application (WAT-03)', () => {
    const object = (kind: string, name: string) => ({ kind, name }) as ObjectSummary;
    const objects = [object('device', 'Dev1'), object('application', 'App1')];
    expect(plainExpression('Dev1.App1.PLC_PRG.ivar', objects)).toBe('PLC_PRG.ivar');
    expect(plainExpression('app1.PLC_PRG.ivar;', objects)).toBe('PLC_PRG.ivar');
    expect(plainExpression('PLC_PRG.ivar', objects)).toBe('PLC_PRG.ivar');
  });
});
