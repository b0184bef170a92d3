import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { DraftStorage } from './drafts';
import { checkSum, isStepsOfParts, KeptSteps, textBefore, UndoSteps } from './undoSteps';

/** All texts that the steps go back over, the oldest last. */
function undone(text: string, steps: UndoSteps): string[] {
  const { steps: all } = steps.of(text);
  const texts: string[] = [];
  for (let count = 1; count <= all.length; count++) {
    const rest = new UndoSteps(all.slice(all.length - count));
    texts.push(textBefore(text, rest.of(text))!);
  }
  return texts;
}

describe('undo steps', () => {
  it('go back over every edit', () => {
    fc.assert(
      fc.property(fc.array(fc.string({ maxLength: 12 }), { minLength: 1, maxLength: 15 }), (texts) => {
        const steps = new UndoSteps();
        // Long pauses: nothing is joined.
        texts.forEach((text, at) => at > 0 && steps.edited(texts[at - 1]!, text, at * 10_000));
        const former = texts.slice(0, -1).filter((text, at) => text !== texts[at + 1]);
        expect(undone(texts.at(-1)!, steps)).toEqual(former.reverse());
      }),
    );
  });

  it('join what is typed without a pause, up to the end of a line', () => {
    const steps = new UndoSteps();
    steps.edited('', 'a', 0);
    steps.edited('a', 'ab', 100);
    steps.edited('ab', 'ab\n', 200);
    steps.edited('ab\n', 'ab\nc', 300);
    steps.edited('ab\nc', 'ab\ncd', 5000);
    expect(undone('ab\ncd', steps)).toEqual(['ab\nc', 'ab\n', '']);
  });

  it('are gone when the editor went back over them, some at once too', () => {
    const steps = new UndoSteps();
    steps.edited('', 'a', 0);
    steps.edited('a', 'b', 10_000);
    steps.edited('b', 'c', 20_000);
    steps.edited('c', 'a', 30_000, true);
    expect(undone('a', steps)).toEqual(['']);
    steps.edited('a', 'x', 40_000, true);
    expect(undone('x', steps)).toEqual(['a', '']);
  });

  it('count only for the text that they lead to', () => {
    const steps = new UndoSteps();
    steps.edited('x := 1;', 'x := 2;', 0);
    const kept = steps.of('x := 2;');
    expect(textBefore('x := 2;', kept)).toBe('x := 1;');
    expect(textBefore('x := 2; // by somebody else', kept)).toBeNull();
    expect(textBefore('y := 2;', kept)).toBeNull();
    steps.clear();
    expect(steps.length).toBe(0);
  });

  it('stay few and small', () => {
    const steps = new UndoSteps();
    let text = '';
    for (let i = 0; i < 1000; i++) {
      const next = `${'x'.repeat(2000)}${i}`;
      steps.edited(text, next, i * 10_000);
      text = next;
    }
    expect(steps.length).toBeLessThanOrEqual(300);
    expect(JSON.stringify(steps.of(text)).length).toBeLessThan(400_000);
    expect(textBefore(text, steps.of(text))).not.toBeNull();
  });
});

describe('a check sum', () => {
  it('tells texts apart', () => {
    fc.assert(fc.property(fc.string(), fc.string(), (a, b) => (checkSum(a) === checkSum(b)) === (a === b)));
  });
});

describe('kept steps', () => {
  function storage(limit = Infinity): DraftStorage & { map: Map<string, string> } {
    const map = new Map<string, string>();
    return {
      map,
      getItem: (key) => map.get(key) ?? null,
      setItem: (key, value) => {
        if (value.length > limit) throw new Error('full');
        map.set(key, value);
      },
      removeItem: (key) => void map.delete(key),
      get length() {
        return map.size;
      },
      key: (index) => [...map.keys()][index] ?? null,
    };
  }
  const steps = () => ({ declaration: new UndoSteps().of('a'), implementation: new UndoSteps().of('b') });

  it('are those of the user and object', () => {
    const kept = new KeptSteps(storage(), isStepsOfParts);
    kept.write('ann', 'p', 'o', steps(), 1);
    expect(kept.read('ann', 'p', 'o')).toEqual(steps());
    expect(kept.read('bob', 'p', 'o')).toBeNull();
    kept.write('ann', 'p', 'o', null, 2);
    expect(kept.read('ann', 'p', 'o')).toBeNull();
  });

  it('are dropped where there is no room, the oldest where there are many, and when they are damaged', () => {
    const small = storage(10);
    new KeptSteps(small, isStepsOfParts).write('ann', 'p', 'o', steps(), 1);
    expect(small.map.size).toBe(0);
    const large = storage();
    const kept = new KeptSteps(large, isStepsOfParts);
    for (let i = 0; i < 100; i++) kept.write('ann', 'p', `o${i}`, steps(), i);
    expect(large.map.size).toBeLessThan(70);
    expect(kept.read('ann', 'p', 'o99')).not.toBeNull();
    expect(kept.read('ann', 'p', 'o0')).toBeNull();
    large.map.set('tappet.undo.ann.p.o99', '{"savedAt": 1, "value": {"declaration": 3}}');
    expect(kept.read('ann', 'p', 'o99')).toBeNull();
  });
});
