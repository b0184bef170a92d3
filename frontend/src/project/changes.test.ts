import { describe, expect, it } from 'vitest';
import type { ObjectSummary } from '@/api/types';
import { applyChange, moved, renamed, without, type ObjectEvent } from './changes';

const object = (id: string, parent_id: string | null, index: number, revision = 1): ObjectSummary => ({
  id,
  kind: 'pou',
  parent_id,
  subkind: null,
  name: id,
  index,
  revision,
  excluded: false,
});
const event = (change: ObjectEvent['change'], changed: ObjectSummary): ObjectEvent => ({
  op: 'object',
  change,
  object: changed,
  author: 'eva',
});
const order = (objects: readonly ObjectSummary[], parent: string | null) =>
  objects
    .filter((one) => one.parent_id === parent)
    .sort((a, b) => a.index - b.index)
    .map((one) => one.id);

const objects = [object('a', null, 0), object('b', null, 1), object('c', null, 2), object('x', 'a', 0)];

describe('events of others', () => {
  it('put a new object at its place', () => {
    const after = applyChange(objects, event('created', object('n', null, 1)));
    expect(order(after, null)).toEqual(['a', 'n', 'b', 'c']);
  });

  it('count the roots of the two views apart', () => {
    const device = { ...object('d', null, 0), kind: 'device' as const };
    const after = applyChange([device, ...objects], event('created', object('n', null, 3)));
    expect(order(after, null).filter((id) => id !== 'd')).toEqual(['a', 'b', 'c', 'n']);
    expect(after.find((one) => one.id === 'd')!.index).toBe(0);
    expect(after.find((one) => one.id === 'n')!.index).toBe(3);
  });

  it('do nothing twice', () => {
    const once = applyChange(objects, event('created', object('n', null, 1)));
    expect(applyChange(once, event('created', object('n', null, 1)))).toEqual(once);
  });

  it('never go back to an older revision', () => {
    const now = [object('a', null, 0, 5)];
    const after = applyChange(now, event('updated', { ...object('a', null, 0, 4), name: 'old' }));
    expect(after[0]!.name).toBe('a');
  });

  it('move between parents and close the gap', () => {
    const after = applyChange(objects, event('moved', object('b', 'a', 0)));
    expect(order(after, 'a')).toEqual(['b', 'x']);
    expect(order(after, null)).toEqual(['a', 'c']);
  });

  it('take away what is below a deleted object, in whatever order it is listed', () => {
    expect(without([object('y', 'x', 0), ...objects], ['a']).map((one) => one.id)).toEqual(['b', 'c']);
  });
});

describe('our own acts', () => {
  it('move within the siblings', () => {
    expect(order(moved(objects, 'c', null, 0), null)).toEqual(['c', 'a', 'b']);
  });
  it('rename', () => {
    expect(renamed(objects, 'b', 'z').find((one) => one.id === 'b')!.name).toBe('z');
  });
});
