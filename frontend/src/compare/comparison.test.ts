import { describe, expect, it } from 'vitest';
import {
  changeAt,
  checkedOf,
  diffRows,
  EVERYTHING,
  filtered,
  NOTHING,
  order,
  outcome,
  takenBlock,
  takes,
  toggled,
  withChoice,
  withPart,
  withText,
  type Choices,
  type Difference,
  type LineChange,
  type State,
} from './comparison';

const side = (path: string, id = path) => ({ id, path, name: path.split('/').at(-1)!, revision: 3 });

function difference(path: string, state: State = 'changed', more: Partial<Difference> = {}): Difference {
  return {
    key: path,
    state,
    kind: 'pou',
    subkind: null,
    old: state === 'added' ? null : side(path),
    new: state === 'removed' ? null : side(path),
    fields: state === 'changed' ? ['declaration', 'implementation'] : [],
    renamed: false,
    moved: false,
    reordered: false,
    ...more,
  };
}

describe('a choice', () => {
  const one = difference('A/B', 'changed', { renamed: true });
  const sides = { old: 'a\nb', now: 'c\nb' };

  it('of everything becomes one of parts when a part is left out, and everything again', () => {
    const parts = withPart(EVERYTHING, one, { field: 'declaration' }, false);
    expect([parts.whole, takes(parts, one, 'name'), takes(parts, one, { field: 'declaration' })]).toEqual([
      false,
      true,
      false,
    ]);
    expect(withPart(parts, one, { field: 'declaration' }, true)).toEqual(EVERYTHING);
  });

  it('holds a text that is neither side, and no text that is one of them', () => {
    const mixed = withText(NOTHING, one, 'declaration', sides, 'x');
    expect(outcome(mixed, one, 'declaration', sides.old, sides.now)).toBe('x');
    expect(withText(mixed, one, 'declaration', sides, sides.now)).toEqual(NOTHING);
    const taken = withText(mixed, one, 'declaration', sides, sides.old);
    expect([taken.fields, taken.texts]).toEqual([['declaration'], {}]);
    expect(outcome(taken, one, 'declaration', sides.old, sides.now)).toBe(sides.old);
  });

  it('becomes a request with the revision that was compared', () => {
    const gone = difference('A/C', 'removed');
    const choices: Choices = new Map([
      ['A/B', withPart(NOTHING, one, 'name', true)],
      ['A/C', EVERYTHING],
    ]);
    expect(order(choices, [one, gone, difference('A/D')])).toEqual([
      { key: 'A/B', base_revision: 3, whole: false, name: true, place: false, fields: [], texts: {} },
      { key: 'A/C', base_revision: null, whole: true, name: false, place: false, fields: [], texts: {} },
    ]);
  });

  it('of a row is one of all below it', () => {
    const all = toggled(['A/B', 'A/C'], new Map());
    expect(checkedOf(['A/B', 'A/C'], all)).toBe('all');
    const some = withChoice(all, 'A/B', NOTHING);
    expect(checkedOf(['A/B', 'A/C'], some)).toBe('some');
    expect(toggled(['A/B', 'A/C'], toggled(['A/B', 'A/C'], some)).size).toBe(0);
  });
});

describe('the tree', () => {
  const differences = [
    difference('PLC/Logic/App/Main'),
    difference('PLC/Logic/App/Drives/FB_A', 'added'),
    difference('PLC/Logic/App/Drives/FB_A/Run', 'added'),
    difference('PLC/Logic/App/Main', 'removed', { key: '-1' }),
  ];
  const shown = (closed: string[] = []) =>
    diffRows(differences, new Set(closed), new Map()).map((row) => `${row.level} ${row.name} ${row.keys.length}`);

  it('joins what does not differ and has one child', () => {
    expect(shown()).toEqual(['1 PLC / Logic / App 4', '2 Main 1', '2 Drives 2', '3 FB_A 2', '4 Run 1', '2 Main 1']);
  });

  it('hides what is below a closed row', () => {
    expect(shown(['PLC/Logic/App'])).toEqual(['1 PLC / Logic / App 4']);
    expect(shown(['PLC/Logic/App/Drives/FB_A'])).not.toContain('4 Run 1');
  });

  it('shows a difference at the root, and nothing of nothing', () => {
    expect(diffRows([difference('PLC')], new Set(), new Map()).map((row) => row.difference?.key)).toEqual(['PLC']);
    expect(diffRows([], new Set(), new Map())).toEqual([]);
  });

  it('is filtered by state and text, also by the former name', () => {
    expect(filtered(differences, new Set<State>(['added', 'removed']), '')).toHaveLength(1);
    expect(filtered(differences, new Set(), 'fb_a')).toHaveLength(2);
    const renamed = difference('X/New', 'changed', { renamed: true, old: side('X/Former') });
    expect(filtered([renamed], new Set(), 'former')).toHaveLength(1);
  });
});

/** The changes between two texts by their longest common lines, as Monaco says them. */
function lineChanges(original: string[], modified: string[]): LineChange[] {
  const table = Array.from({ length: original.length + 1 }, () => new Array<number>(modified.length + 1).fill(0));
  for (let i = original.length - 1; i >= 0; i--)
    for (let j = modified.length - 1; j >= 0; j--)
      table[i]![j] =
        original[i] === modified[j] ? table[i + 1]![j + 1]! + 1 : Math.max(table[i + 1]![j]!, table[i]![j + 1]!);
  const changes: LineChange[] = [];
  let [i, j] = [0, 0];
  while (i < original.length || j < modified.length) {
    const [from, to] = [i, j];
    while (i < original.length || j < modified.length) {
      if (i < original.length && j < modified.length && original[i] === modified[j]) break;
      if (j >= modified.length || (i < original.length && table[i + 1]![j]! >= table[i]![j + 1]!)) i++;
      else j++;
    }
    if (i > from || j > to)
      changes.push({
        originalStartLineNumber: i > from ? from + 1 : from,
        originalEndLineNumber: i > from ? i : 0,
        modifiedStartLineNumber: j > to ? to + 1 : to,
        modifiedEndLineNumber: j > to ? j : 0,
      });
    while (i < original.length && j < modified.length && original[i] === modified[j]) [i, j] = [i + 1, j + 1];
  }
  return changes;
}

describe('blocks', () => {
  const random = (seed: number) => () => (seed = (seed * 1103515245 + 12345) % 2147483648) / 2147483648;
  const lines = (next: () => number) =>
    Array.from({ length: 1 + Math.floor(next() * 9) }, () => 'abc'[Math.floor(next() * 3)]!);

  it('all taken over give the other text, whatever the order', () => {
    const next = random(7);
    for (let round = 0; round < 400; round++) {
      const original = lines(next);
      let modified = lines(next);
      for (let left = 0; ; left++) {
        const changes = lineChanges(original, modified);
        if (changes.length === 0) break;
        expect(left).toBeLessThan(40);
        const change = changes[Math.floor(next() * changes.length)]!;
        modified = takenBlock(original.join('\n'), modified.join('\n'), change).split('\n');
        expect(lineChanges(original, modified).length).toBeLessThan(changes.length);
      }
      expect(modified).toEqual(original);
    }
  });

  it('are found by the line of the cursor', () => {
    const changes = lineChanges(['a', 'b', 'c'], ['x', 'b', 'y']);
    expect(changeAt(changes, 1)).toBe(changes[0]);
    expect(changeAt(changes, 2)).toBe(changes[1]);
    expect(changeAt(changes, 9)).toBe(changes[0]);
    expect(changeAt([], 1)).toBeUndefined();
  });
});
