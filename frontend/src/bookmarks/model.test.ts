import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { ObjectSummary } from '@/api/types';
import { followed, fromStored, inOrder, keyOf, relocated, stepFrom, toggled, type Bookmark, type Lines, type TextChange } from './model'; // prettier-ignore

const PART = { objectId: 'a', part: 'implementation' } as const;
const lines = (text: string): Lines => {
  const all = text.split('\n');
  return { count: all.length, line: (number) => all[number - 1]! };
};
const marks = (text: string, ...numbers: number[]): Bookmark[] =>
  numbers.map((line) => ({ ...PART, line, text: lines(text).line(line) }));

type Edit = [from: [number, number], to: [number, number], text: string];
const change = ([from, to, text]: Edit): TextChange => ({
  range: { startLineNumber: from[0], startColumn: from[1], endLineNumber: to[0], endColumn: to[1] },
  text,
});
const offset = (text: string, [line, column]: readonly [number, number]) =>
  text.split('\n').slice(0, line - 1).join('\n').length + (line > 1 ? 1 : 0) + column - 1; // prettier-ignore
const applied = (text: string, [from, to, inserted]: Edit) =>
  text.slice(0, offset(text, from)) + inserted + text.slice(offset(text, to));

/** Where the bookmarks of a text are after edits, given from below upwards. */
function after(text: string, numbers: number[], ...edits: Edit[]): number[] {
  const now = edits.reduce(applied, text);
  return followed(marks(text, ...numbers), PART, edits.map(change), lines(now)).map(({ line }) => line);
}

const TEXT = 'a := 1;\n  b := 2;\n\nc := 3;\nd := 4;';

describe('bookmarks follow edits', () => {
  it('above them, and stay with edits below and within their line', () => {
    expect(after(TEXT, [2, 5], [[1, 1], [1, 1], 'x;\ny;\n'])).toEqual([4, 7]);
    expect(after(TEXT, [1, 2], [[4, 1], [5, 1], ''])).toEqual([1, 2]);
    expect(after(TEXT, [2], [[2, 8], [2, 9], '20'])).toEqual([2]);
    expect(after(TEXT, [4], [[1, 1], [3, 1], ''])).toEqual([2]);
  });

  it('stay with the text when a line is broken or joined', () => {
    expect(after(TEXT, [2], [[2, 1], [2, 1], '\n'])).toEqual([3]);
    expect(after(TEXT, [2], [[2, 3], [2, 3], '\n  '])).toEqual([3]);
    expect(after(TEXT, [2], [[2, 5], [2, 5], '\n'])).toEqual([2]);
    expect(after(TEXT, [2], [[2, 10], [2, 10], '\n'])).toEqual([2]);
    expect(after(TEXT, [4], [[3, 1], [4, 1], ''])).toEqual([3]);
    expect(after(TEXT, [4, 5], [[4, 8], [5, 1], ' '])).toEqual([4]);
    expect(after(TEXT, [3], [[2, 10], [3, 1], ''])).toEqual([2]);
  });

  it('go with lines that are deleted', () => {
    expect(after(TEXT, [2, 4], [[2, 1], [3, 1], ''])).toEqual([3]);
    expect(after(TEXT, [5], [[4, 8], [5, 8], ''])).toEqual([]);
    expect(after(TEXT, [3], [[3, 1], [4, 1], ''])).toEqual([]);
  });

  it('are found in a text that replaces their lines', () => {
    expect(after(TEXT, [2], [[1, 1], [4, 1], 'new;\n    b := 2;\n'])).toEqual([2]);
    expect(after(TEXT, [4, 5], [[1, 1], [5, 8], 'd := 4;\nx;\nc := 3;'])).toEqual([3, 1]);
  });

  it('that come together become one', () => {
    expect(after(TEXT, [4, 5], [[4, 8], [5, 1], ' '])).toHaveLength(1);
  });

  it('of several places at once', () => {
    expect(after(TEXT, [2, 4], [[4, 1], [4, 1], 'x;\n'], [[1, 1], [1, 1], 'y;\n'])).toEqual([3, 6]);
  });

  it('keep what their line holds, and leave those of other texts alone', () => {
    const other: Bookmark = { objectId: 'b', part: 'implementation', line: 1, text: 'q' };
    const edit: Edit = [[1, 6], [1, 7], '17']; // prettier-ignore
    const now = lines(applied(TEXT, edit));
    expect(followed([...marks(TEXT, 1), other], PART, [change(edit)], now)).toEqual([
      { ...PART, line: 1, text: 'a := 17;' },
      other,
    ]);
    const same = [...marks(TEXT, 1), other];
    expect(followed(same, { ...PART, part: 'declaration' }, [change(edit)], now)).toBe(same);
  });

  it('of lines that no other is like, whatever is edited around them', () => {
    const line = fc.integer({ min: 0, max: 30 });
    fc.assert(
      fc.property(line, line, fc.array(fc.constantFrom('', 'x', '  y'), { maxLength: 4 }), line, (a, b, put, at) => {
        const before = Array.from({ length: 32 }, (_, index) => `line${String(index)};`);
        const [from, to] = [Math.min(a, b), Math.max(a, b)];
        const text = before.join('\n');
        const edit: Edit = [[from + 1, 1], [to + 1, 1], put.map((one) => `${one}\n`).join('')]; // prettier-ignore
        const expected = applied(text, edit)
          .split('\n')
          .indexOf(`line${String(at)};`);
        expect(after(text, [at + 1], edit)).toEqual(expected < 0 ? [] : [expected + 1]);
      }),
    );
  });
});

describe('bookmarks', () => {
  it('are found again in a text that was changed elsewhere', () => {
    const found = (numbers: number[], now: string) =>
      relocated(marks(TEXT, ...numbers), PART, lines(now)).map(({ line }) => line);
    expect(found([2, 4], TEXT)).toEqual([2, 4]);
    expect(found([2], `x;\ny;\n${TEXT}`)).toEqual([4]);
    expect(found([5], 'c := 3;\nd := 4;')).toEqual([2]);
    expect(found([4], 'only')).toEqual([1]);
    expect(found([4, 5], 'only')).toEqual([1]);
  });

  it('are set and taken away', () => {
    const [one, two] = marks(TEXT, 1, 2) as [Bookmark, Bookmark];
    expect(toggled([one], two)).toEqual([one, two]);
    expect(toggled([one, two], { ...one, text: 'other' })).toEqual([two]);
  });

  it('are gone through in the order of the tree and around its end', () => {
    const object = (id: string, index: number, parent: string | null = null) =>
      ({ id, name: id, kind: 'pou', parent_id: parent, index }) as ObjectSummary;
    const objects = [object('b', 0), object('c', 0, 'b'), object('a', 1)];
    const at = (objectId: string, line: number, part: Bookmark['part'] = 'implementation') =>
      ({ objectId, part, line, text: '' }) satisfies Bookmark;
    const all = [at('a', 1), at('b', 9), at('b', 2), at('c', 1), at('b', 5, 'declaration'), at('gone', 1)];
    const order = ['b/declaration/5', 'b/implementation/2', 'b/implementation/9', 'c/implementation/1', 'a/implementation/1']; // prettier-ignore
    expect(inOrder(all, objects).map(keyOf)).toEqual(order);
    const next = (from: Bookmark | null, by: 1 | -1) => keyOf(stepFrom(all, objects, from, by)!);
    expect(next(null, 1)).toBe(order[0]);
    expect(next(null, -1)).toBe(order[4]);
    expect(next(at('b', 2), 1)).toBe(order[2]);
    expect(next(at('b', 4), -1)).toBe(order[1]);
    expect(next(at('a', 1), 1)).toBe(order[0]);
    expect(next(at('b', 1, 'declaration'), -1)).toBe(order[4]);
    expect(stepFrom([], objects, null, 1)).toBeUndefined();
  });

  it('that were stored by something else are left out', () => {
    const [good] = marks(TEXT, 1);
    expect(fromStored([good, null, 7, { ...good, line: 0 }, { ...good, part: 'x' }])).toEqual([good]);
    expect(fromStored({})).toEqual([]);
  });
});
