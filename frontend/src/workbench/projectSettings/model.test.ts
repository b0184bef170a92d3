import { expect, it } from 'vitest';
import type { ProjectObject } from '@/api/types';
import { changedObjects, withChanges } from './model';

const object = (id: string, limit: number) =>
  ({ id, kind: 'application', name: id, revision: 4, data: { heap: { limit_kib: limit, poison: false } } }) as ProjectObject; // prettier-ignore
const objects = [object('a', 1), object('b', 2), object('c', 3)];
const data = (limit: number) => object('', limit).data;

it('shows what was changed and saves nothing else', () => {
  const changes = { b: data(20), c: data(3) };
  expect(withChanges(objects, changes).map((one) => one.data)).toEqual([data(1), data(20), data(3)]);
  expect(changedObjects(objects, changes)).toEqual([{ object_id: 'b', base_revision: 4, data: data(20) }]);
  expect(changedObjects(objects, {})).toEqual([]);
});
