import { afterEach, expect, it, vi } from 'vitest';
import { api } from '@/api/client';
import { queryClient } from '@/api/queries';
import { logQuery } from './logQuery';

afterEach(() => {
  vi.restoreAllMocks();
  queryClient.clear();
});

/** A runtime with these lines: it answers with those behind the one that it is asked for. */
function runtime(lines: () => readonly number[]) {
  vi.spyOn(api, 'get').mockImplementation(((_path: string, { params }: { params: { query: { since: number } } }) =>
    Promise.resolve(
      lines()
        .filter((id) => id > params.query.since)
        .map((id) => ({ id, message: `line ${String(id)}` })),
    )) as unknown as typeof api.get);
}

const read = async (since: string): Promise<readonly number[]> =>
  (await queryClient.fetchQuery({ ...logQuery('local', since), staleTime: 0 })).map(({ id }) => id);

it('grows, and begins anew with a runtime that was started again', async () => {
  let lines = [1, 2, 3];
  runtime(() => lines);
  expect(await read('10:00')).toEqual([1, 2, 3]);
  lines = [1, 2, 3, 4];
  expect(await read('10:00')).toEqual([1, 2, 3, 4]);
  lines = [1, 2];
  expect(await read('10:05')).toEqual([1, 2]);
});
