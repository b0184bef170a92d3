import { expect, test } from 'vitest';
import { lastSteps } from './keptSteps';

test('the last steps are kept as far as there is room', () => {
  const small = Array.from({ length: 40 }, (_, at) => ({ at }));
  expect(lastSteps(small)).toEqual(small.slice(-30));
  const large = small.map(({ at }) => ({ at, picture: 'x'.repeat(150_000) }));
  expect(lastSteps(large).map(({ at }) => at)).toEqual([38, 39]);
  expect(lastSteps([{ picture: 'x'.repeat(500_000) }])).toEqual([]);
});
