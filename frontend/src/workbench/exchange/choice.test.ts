import { describe, expect, it } from 'vitest';
import { objectSample } from '../../../tests/objectSample';
import {
  checkedOf,
  nodeForest,
  nodeRows,
  projectForest,
  requestOf,
  toggled,
  withAllBelow,
  type ChoiceNode,
} from './choice';

const node = (key: string, parent: string | null, name = key): ChoiceNode => ({
  key,
  parent,
  kind: 'pou',
  subkind: null,
  name,
  excluded: false,
});
const forest = nodeForest([
  node('a', null, 'FB_Pump'),
  node('a.0', 'a', 'Start'),
  node('a.1', 'a', 'Stop'),
  node('b', null),
]);
const all = new Set(['a', 'a.0', 'a.1', 'b']);

describe('the tree to choose from', () => {
  it('is chosen with what is below', () => {
    const without = toggled(forest, all, 'a.1');
    expect([...checkedOf(forest, without)].sort()).toEqual([
      ['a', 'some'],
      ['a.0', 'all'],
      ['a.1', 'none'],
      ['b', 'all'],
    ]);
    expect(toggled(forest, without, 'a')).toEqual(all);
    const nothing = toggled(forest, toggled(forest, all, 'a'), 'b');
    expect(nothing.size).toBe(0);
    expect(checkedOf(forest, toggled(forest, nothing, 'a.0')).get('a')).toBe('some');
  });

  it('is searched by name and keeps what a match stands in', () => {
    const names = (search: string, closed: string[] = []) =>
      nodeRows(forest, new Set(closed), search).map((row) => [row.node.name, row.level]);
    expect(names('')).toEqual([
      ['FB_Pump', 1],
      ['Start', 2],
      ['Stop', 2],
      ['b', 1],
    ]);
    expect(names('', ['a'])).toEqual([
      ['FB_Pump', 1],
      ['b', 1],
    ]);
    expect(names('STO', ['a'])).toEqual([
      ['FB_Pump', 1],
      ['Stop', 2],
    ]);
  });
});

const objects = [
  objectSample('shared', 'folder', null, 0),
  objectSample('plc', 'device', null, 1),
  objectSample('b', 'pou', 'app', 1),
  objectSample('a', 'pou', 'app', 0),
  objectSample('app', 'application', 'plc', 0),
  objectSample('m', 'method', 'a', 0),
];

describe('a choice of objects of a project', () => {
  const forest = projectForest(objects);

  it('is made in the order of the trees', () => {
    expect(forest.nodes.map(({ path }) => path)).toEqual([
      'PLC',
      'PLC/APP',
      'PLC/APP/A',
      'PLC/APP/A/M',
      'PLC/APP/B',
      'SHARED',
    ]);
    expect([...withAllBelow(objects, [objects[3]!])]).toEqual(['a', 'm']);
  });

  it.each([
    [['plc', 'app', 'a', 'm', 'b', 'shared'], ['plc', 'shared'], []],
    [['plc', 'app', 'b'], ['plc'], ['a']],
    [['plc', 'app', 'm', 'b'], ['plc', 'm'], ['a']],
    [['a'], ['a'], ['m']],
    [[], [], []],
  ])('of %j is named by few', (chosen, object, without) => {
    expect(requestOf(forest, new Set(chosen))).toEqual({ object, without });
  });
});
