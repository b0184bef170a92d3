import { expect, it } from 'vitest';
import { withChange } from './presence';

const ann = { id: 1, username: 'ann', object_id: null };
const bob = { id: 2, username: 'bob', object_id: 'a' };
const cat = { id: 3, username: 'cat', object_id: null };

it('whoever opens something else keeps the place, new ones come last, others leave', () => {
  const moved = { ...ann, object_id: 'b' };
  expect(withChange([ann, bob], { present: [moved, cat], left: [2] })).toEqual([moved, cat]);
});

it('who left without ever having been listed changes nothing', () => {
  expect(withChange([ann, bob], { present: [], left: [9] })).toEqual([ann, bob]);
});
