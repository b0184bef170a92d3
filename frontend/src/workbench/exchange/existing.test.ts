import { describe, expect, it } from 'vitest';
import type { ImportNode } from '@/api/types';
import {
  decisionsOf,
  existingRows,
  NOTHING_CHOSEN,
  undecidedEntries,
  withChoice,
  wrongNames,
  type Choices,
} from './existing';
import { nodeForest } from './choice';

type Existing = NonNullable<ImportNode['existing']>;

function node(key: string, parent: string | null, existing?: Partial<Existing>): ImportNode {
  return {
    key,
    parent,
    kind: 'pou',
    subkind: null,
    name: key,
    source: 'a.st',
    line: 1,
    excluded: false,
    existing: existing
      ? {
          object_id: key,
          path: key,
          acts: ['overwrite', 'rename', 'merge', 'skip'],
          same: false,
          proposal: `${key}_1`,
          ...existing,
        }
      : null,
  };
}

const forest = nodeForest([
  node('Pump', null, {}),
  node('Start', 'Pump', {}),
  node('Pause', 'Pump'),
  node('State', null, { same: true }),
  node('List', null, { acts: ['rename', 'skip'] }),
]);
const every = new Set(forest.nodes.map(({ key }) => key));
const acts = (choices: Choices, chosen = every) =>
  Object.fromEntries(existingRows(forest, chosen, choices).map(({ node, act }) => [node.key, act]));

describe('objects that exist', () => {
  it('come in beside what is there, equal ones stay out', () => {
    expect(acts(NOTHING_CHOSEN)).toEqual({ Pump: 'rename', State: 'skip', List: 'rename' });
  });

  it('follow what is said for all, where that is possible', () => {
    const all: Choices = { ...NOTHING_CHOSEN, all: 'merge' };
    expect(acts(all)).toEqual({ Pump: 'merge', Start: 'merge', State: 'skip', List: 'rename' });
    expect(acts(all, new Set(['List']))).toEqual({ List: 'rename' });
  });

  it('follow the object they are in, until something is said of themselves', () => {
    const pump = withChoice(NOTHING_CHOSEN, 'Pump', { act: 'skip' });
    expect(acts(pump)).toMatchObject({ Pump: 'skip', Start: 'skip' });
    expect(acts(withChoice(pump, 'Start', { act: 'overwrite' }))).toMatchObject({ Pump: 'skip', Start: 'overwrite' });
  });

  it('are sent with their names and texts', () => {
    let choices = withChoice(NOTHING_CHOSEN, 'Pump', { act: 'merge', texts: { declaration: 'x' } });
    choices = withChoice(choices, 'List', { name: ' Other ' });
    expect(decisionsOf(existingRows(forest, every, choices), choices)).toEqual({
      all: 'rename',
      objects: {
        Pump: { act: 'merge', name: null, texts: { declaration: 'x' } },
        Start: { act: 'merge', name: null, texts: {} },
        State: { act: 'skip', name: null, texts: {} },
        List: { act: 'rename', name: 'Other', texts: {} },
      },
    });
  });

  it('are no news of the preview', () => {
    const entry = (outcome: 'changed' | 'imported', object: string) => ({
      outcome,
      object,
      source: 'a.st',
      line: 1,
      text: '',
      object_id: null,
    });
    const entries = [entry('changed', 'Pump'), entry('changed', 'Pause'), entry('imported', 'Other')];
    expect(undecidedEntries(entries, forest.nodes)).toEqual([entries[1]]);
  });

  it('need names of their own', () => {
    const twice = withChoice(withChoice(NOTHING_CHOSEN, 'Pump', { name: 'a' }), 'List', { name: 'A' });
    const rows = existingRows(forest, every, twice);
    expect(wrongNames(rows, () => false)).toEqual(new Set(['Pump', 'List']));
    const one = existingRows(forest, every, withChoice(NOTHING_CHOSEN, 'Pump', { name: ' ' }));
    expect(wrongNames(one, (_, name) => name === 'list_1')).toEqual(new Set(['Pump', 'List']));
  });
});
