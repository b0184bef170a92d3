import { describe, expect, it } from 'vitest';
import type { ObjectSummary, PlacementRule } from '@/api/types';
import { kindWithRole } from './kinds';
import answers from './placement.json';
import { dropPlace, firstChoice, fixedNames, mayDrop, nameFault, placeableKinds, proposedName } from './placement';
import { forestOf, isWithin } from './tree';

/** The table that the server sends, and what it says itself of a project with every kind: `make generate`. */
const RULES = answers.rules as PlacementRule[];
const OBJECTS: readonly ObjectSummary[] = answers.objects;
const forest = forestOf(OBJECTS);
const named = (name: string) => OBJECTS.find((object) => object.name === name)!;
const ruleOf = (kind: string) => RULES.find((rule) => rule.kind === kind)!;

describe('the table of places', () => {
  const offered: Record<string, Record<string, string>> = answers.offered;
  const parents = ['devices', 'pous', ...forest.byId.keys()];

  it('offers the kinds that the server takes, under the names that it gives', () => {
    for (const parent of parents) {
      const view = parent === 'devices' ? 'devices' : 'pous';
      const parentId = forest.byId.has(parent) ? parent : null;
      const kinds = placeableKinds(RULES, forest, parentId, view);
      const names = kinds.map((rule) => [rule.kind, proposedName(rule, forest, parentId)]);
      expect(Object.fromEntries(names), parent).toEqual(offered[parent] ?? {});
    }
  });

  it.each(['move', 'copy'] as const)('lets a drag %s objects where the server does', (act) => {
    const said: Record<string, { yes: (string | null)[]; taken: (string | null)[] }> = answers[act];
    for (const object of OBJECTS) {
      const { yes, taken } = said[object.id]!;
      const view = object.kind === kindWithRole('device')?.kind ? 'devices' : 'pous';
      for (const parent of [null, ...forest.byId.keys()]) {
        // A copy may go into what it is a copy of, but nobody drags to say so.
        if (taken.includes(parent) || isWithin(forest, parent ?? '', object.id)) continue;
        const may = mayDrop(RULES, forest, [object.id], parent, view, act === 'copy');
        expect(may, `${act} ${object.name} ${object.id} to ${String(parent)}`).toBe(yes.includes(parent));
      }
    }
  });

  it.each(answers.named)('takes the names of a $kind that the server takes', ({ kind, parent, good }) => {
    const fine = answers.names.flat().filter((name) => nameFault(RULES, kind, forest, parent, name) === null);
    expect(fine).toEqual(good);
  });

  it('offers folders last, and the fixed names that are left', () => {
    const kinds = placeableKinds(RULES, forest, named('Application').id, 'devices').map(({ kind }) => kind);
    expect(kinds.at(-1)).toBe(kindWithRole('folder')?.kind);
    expect(fixedNames(ruleOf('accessor'), forest, named('Single').id)).toEqual(['Set']);
  });

  it('says what is wrong with a name', () => {
    const application = named('Application').id;
    const fault = (name: string, own?: string) => nameFault(RULES, 'pou', forest, application, name, own)?.key ?? null;
    expect(fault('')).toBe('name.empty');
    expect(fault('1st')).toBe('name.identifier');
    expect(fault('a__b')).toBe('name.underscores');
    expect(fault('While')).toBe('name.reserved');
    expect(fault('nested')).toBe('name.taken');
    expect(fault('nested', named('Nested').id)).toBeNull();
    expect(nameFault(RULES, 'folder', forest, application, 'a.b')?.key).toBe('name.separators');
  });

  it('finds the place of a drop', () => {
    const target = named('Folder');
    const owner = target.parent_id;
    expect(dropPlace(forest, target, 'inside')).toEqual({ parentId: target.id, index: 3 });
    expect(dropPlace(forest, target, 'before')).toEqual({ parentId: owner, index: target.index });
    expect(dropPlace(forest, target, 'after')).toEqual({ parentId: owner, index: target.index + 1 });
  });
});

describe('the kind that Add Object begins with', () => {
  const [folder, pou] = [ruleOf('folder'), ruleOf('pou')];
  it('is a POU where there may be one, unless another was asked for', () => {
    expect(firstChoice([folder, pou])).toBe(pou);
    expect(firstChoice([folder, pou], 'folder')).toBe(folder);
    expect(firstChoice([folder])).toBe(folder);
  });
});
