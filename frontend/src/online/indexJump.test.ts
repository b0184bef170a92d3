import { describe, expect, it } from 'vitest';
import { arrayAround, boundsText, extentOf, locate, readIndices } from './indexJump';
import type { SymbolChild } from './symbols';
import { flatten, type OnlineRoot } from './treeRows';

/** An array as the server lists it: pages of 1,000 elements, in pages of pages where there are more than a million. */
class Listed {
  readonly asked: string[] = [];
  constructor(
    private readonly bounds: readonly (readonly [number, number])[],
    private readonly most: number,
    private readonly inner?: Listed,
  ) {}

  children = (path: string): Promise<readonly SymbolChild[]> => {
    this.asked.push(path);
    const ends = /\[([^[\]]*)\]$/.exec(path)?.[1];
    const below = /^a\[[^[\].]*\](.*)$/.exec(path)?.[1];
    if (this.inner !== undefined && below !== undefined) return this.inner.children(`a${below}`);
    const [first, last] =
      ends === undefined
        ? [0, this.count - 1]
        : (ends.split('..').map((text) => this.number(text)) as [number, number]);
    let size = 1;
    if (last - first + 1 > this.most) {
      size = this.most;
      while (last - first + 1 > size * this.most) size *= this.most;
    }
    const names: string[] = [];
    for (let at = first; at <= last; at += size)
      names.push(size === 1 ? `[${this.text(at)}]` : `[${this.text(at)}..${this.text(Math.min(at + size - 1, last))}]`);
    const leaf = size === 1 && this.inner === undefined;
    const kind = size > 1 ? 'part' : leaf ? 'int' : 'array';
    return Promise.resolve(names.map((name): SymbolChild => ({ name, path: `a${name}`, type: '', kind, leaf })));
  };

  private get count(): number {
    return this.bounds.reduce((product, [low, high]) => product * (high - low + 1), 1);
  }

  private text(number: number): string {
    const indices = [];
    for (const [low, high] of [...this.bounds].reverse()) {
      const size = high - low + 1;
      indices.unshift(low + (number % size));
      number = Math.floor(number / size);
    }
    return indices.join(', ');
  }

  private number(text: string): number {
    return text.split(',').reduce((number, each, dimension) => {
      const [low, high] = this.bounds[dimension]!;
      return number * (high - low + 1) + Number(each) - low;
    }, 0);
  }
}

const ARRAY = { key: 'r', expression: 'a', label: 'a', kind: 'array' };
const outside = (index: string, bounds: string) => ({
  ok: false,
  reason: 'online.index.outside',
  values: { index, bounds },
});

describe('what is typed', () => {
  it.each([
    ['5', [[5n]]],
    [' [ 2 , -7 ] ', [[2n, -7n]]],
    ['[2][16#1F]', [[2n], [31n]]],
    ['1_000', [[1000n]]],
  ])('reads %s', (text, indices) => expect(readIndices(text)).toEqual(indices));
  it.each(['', 'x', '[1', '[1] 2', '1..2', '[]', '1.5', '[1,]'])('refuses %j', (text) =>
    expect(readIndices(text)).toBeNull(),
  );
});

describe('the element', () => {
  it('is found through the pages of a large array', async () => {
    const array = new Listed([[0, 2_499_999]], 1000);
    expect(await locate(array.children, ARRAY, '2000001')).toEqual({
      ok: true,
      opened: ['r', 'r/[2000000..2499999]', 'r/[2000000..2499999]/[2000000..2000999]'],
      key: 'r/[2000000..2499999]/[2000000..2000999]/[2000001]',
    });
    // Three questions, whatever the size.
    expect(array.asked).toEqual(['a', 'a[2000000..2499999]', 'a[2000000..2000999]']);
  });

  it('is found by the order of elements in each page of several dimensions', async () => {
    const bounds = [
      [-1, 4],
      [3, 9],
      [0, 2],
    ] as const;
    const array = new Listed(bounds, 4);
    for (let i = -1; i <= 4; i += 1)
      for (let j = 3; j <= 9; j += 1)
        for (let k = 0; k <= 2; k += 1) {
          const found = await locate(array.children, ARRAY, `[${String(i)}, ${String(j)}, ${String(k)}]`);
          expect(found.ok && found.key.endsWith(`/[${String(i)}, ${String(j)}, ${String(k)}]`)).toBe(true);
        }
    // It lies between the first and the last element, but has no row: the second index is beyond its bounds.
    expect(await locate(array.children, ARRAY, '0, 10, 0')).toEqual(outside('0, 10, 0', '-1..4, 3..9, 0..2'));
  });

  it('is found in an array of arrays', async () => {
    const array = new Listed([[1, 3]], 1000, new Listed([[0, 2499]], 1000));
    expect(await locate(array.children, ARRAY, '[2][1500]')).toEqual({
      ok: true,
      opened: ['r', 'r/[2]', 'r/[2]/[1000..1999]'],
      key: 'r/[2]/[1000..1999]/[1500]',
    });
    expect(await locate(array.children, ARRAY, '[2][2500]')).toEqual(outside('2500', '0..2499'));
  });

  it('is refused with the bounds', async () => {
    const array = new Listed([[-5, 2000]], 1000);
    expect(await locate(array.children, ARRAY, '2001')).toEqual(outside('2001', '-5..2000'));
    expect(await locate(array.children, ARRAY, '-6')).toEqual(outside('-6', '-5..2000'));
    expect(await locate(array.children, ARRAY, 'i')).toMatchObject({ reason: 'online.index.noIndices' });
    expect(await locate(array.children, ARRAY, '1, 2')).toEqual({
      ok: false,
      reason: 'online.index.dimensions',
      values: { count: 1, bounds: '-5..2000' },
    });
    expect(await locate(array.children, ARRAY, '[1][2]')).toMatchObject({ reason: 'online.index.noArray' });
  });

  it('of a page that is watched alone lies in the page', async () => {
    const array = new Listed([[0, 9999], [0, 1]], 1000); // prettier-ignore
    const page = { key: 'p', expression: 'a[500, 0..999, 1]', label: '', kind: 'part' };
    expect(await locate(array.children, page, '700, 1')).toMatchObject({ ok: true, key: 'p/[700, 1]' });
    expect(await locate(array.children, page, '1000, 0')).toEqual(outside('1000, 0', '500, 0..999, 1'));
    expect(await locate(array.children, page, '700, 2')).toEqual(outside('700, 2', '500, 0..999, 1'));
  });
});

it('takes bounds from the first and the last row', async () => {
  const extent = extentOf(await new Listed([[-2, 7], [1, 3]], 4).children('a'))!; // prettier-ignore
  expect(boundsText(extent, false)).toBe('-2..7, 1..3');
  expect(extentOf([])).toBeNull();
});

it('belongs to the innermost array around a row', async () => {
  const array = new Listed([[0, 2499]], 1000);
  const row = (key: string, kind: string): OnlineRoot => ({
    key,
    expression: key,
    label: key,
    kind,
    leaf: kind === 'int',
  });
  const children = new Map([
    ['A', await array.children('a')],
    ['A[1000..1999]', await array.children('a[1000..1999]')],
  ]);
  const roots = [row('n', 'int'), row('a', 'array'), row('m', 'int'), row('a[0..9]', 'part')];
  const rows = flatten(roots, new Set(['a', 'a/[1000..1999]']), children);
  const arrayOf = (key: string) =>
    arrayAround(
      rows,
      rows.findIndex((each) => each.key === key),
    )?.key ?? null;
  expect(arrayOf('n')).toBeNull();
  expect(arrayOf('a')).toBe('a');
  expect(arrayOf('a/[1000..1999]/[1500]')).toBe('a');
  expect(arrayOf('a/[2000..2499]')).toBe('a');
  expect(arrayOf('m')).toBeNull();
  expect(arrayOf('a[0..9]')).toBe('a[0..9]');
});
