import { describe, expect, it } from 'vitest';
import type { ObjectSummary, PlacementRule } from '@/api/types';
import { forestOf } from './tree';
import { dropPlace, firstChoice, fixedNames, mayDrop, nameFault, placeableKinds, proposedName } from './placement';

const rule = (kind: string, parents: string[], more: Partial<PlacementRule> = {}): PlacementRule => ({
  kind,
  parents,
  parent_subkinds: [],
  in_folders: true,
  once: false,
  naming: 'identifier',
  names: [],
  proposal: kind.toUpperCase(),
  subkinds: [],
  languages: [],
  ...more,
});

const RULES = [
  rule('folder', ['application', 'pous_view', 'folder', 'pou'], {
    naming: 'free',
    parent_subkinds: ['program', 'function_block'],
  }),
  rule('device', ['devices_view'], { naming: 'free' }),
  rule('pou', ['application', 'pous_view'], { proposal: 'POU' }),
  rule('method', ['pou', 'interface'], { parent_subkinds: ['program', 'function_block'], proposal: 'Method' }),
  rule('accessor', ['property'], { naming: 'fixed', names: ['Get', 'Set'], in_folders: false }),
  rule('task_configuration', ['application'], {
    once: true,
    in_folders: false,
    naming: 'fixed',
    names: ['Task Configuration'],
  }),
];

let index = 0;
const object = (id: string, kind: string, parent_id: string | null, subkind: string | null = null): ObjectSummary => ({
  id,
  kind,
  parent_id,
  subkind,
  name: id,
  index: index++,
  revision: 1,
});

const forest = forestOf([
  object('Device', 'device', null),
  object('App', 'application', 'Device'),
  object('Lib', 'pou', null, 'function_block'),
  object('Fun', 'pou', 'App', 'function'),
  object('Folder', 'folder', 'App'),
  object('FB', 'pou', 'Folder', 'function_block'),
  object('Prop', 'property', 'FB'),
  object('Get', 'accessor', 'Prop'),
]);
const kinds = (parent: string | null, view: 'devices' | 'pous') =>
  placeableKinds(RULES, forest, parent, view).map((entry) => entry.kind);

describe('placement', () => {
  it('offers at the roots what each view takes', () => {
    expect(kinds(null, 'devices')).toEqual(['device']);
    expect(kinds(null, 'pous')).toEqual(['pou', 'folder']);
  });

  it('lets a folder take what its owner takes, except what stands directly at the owner', () => {
    expect(kinds('App', 'devices')).toEqual(['pou', 'task_configuration', 'folder']);
    expect(kinds('Folder', 'devices')).toEqual(['pou', 'folder']);
  });

  it('looks at what the POU is', () => {
    expect(kinds('FB', 'devices')).toEqual(['method', 'folder']);
    expect(kinds('Fun', 'devices')).toEqual([]);
  });

  it('offers the fixed names that are left', () => {
    expect(fixedNames(RULES[4]!, forest, 'Prop')).toEqual(['Set']);
    expect(proposedName(RULES[4]!, forest, 'Prop')).toBe('Set');
  });

  it('proposes PLC_PRG for the first POU of an application only', () => {
    const empty = forestOf([object('A', 'application', null)]);
    expect(proposedName(RULES[2]!, empty, 'A')).toBe('PLC_PRG');
    expect(proposedName(RULES[2]!, forest, 'App')).toBe('POU');
  });

  it('finds what is wrong with a name', () => {
    const fault = (name: string, own?: string) => nameFault(RULES[2], forest, 'App', name, own)?.key ?? null;
    expect(fault('')).toBe('name.empty');
    expect(fault('1st')).toBe('name.identifier');
    expect(fault('a__b')).toBe('name.underscores');
    expect(fault('fb')).toBe('name.taken');
    expect(fault('fb', 'FB')).toBeNull();
    expect(fault('Motor')).toBeNull();
    expect(nameFault(RULES[0], forest, 'App', 'a.b')?.key).toBe('name.separators');
  });

  it('does not let an object into itself', () => {
    expect(mayDrop(RULES, forest, ['Folder'], 'Folder', 'devices')).toBe(false);
    expect(mayDrop(RULES, forest, ['Folder'], 'FB', 'devices')).toBe(false);
    expect(mayDrop(RULES, forest, ['Lib'], 'Folder', 'devices')).toBe(true);
  });

  it('counts a unique object as another only when it is copied', () => {
    const one = forestOf([object('A', 'application', null), object('Task Configuration', 'task_configuration', 'A')]);
    expect(mayDrop(RULES, one, ['Task Configuration'], 'A', 'devices')).toBe(true);
    expect(mayDrop(RULES, one, ['Task Configuration'], 'A', 'devices', true)).toBe(false);
  });

  it('finds the place of a drop', () => {
    const target = forest.byId.get('Folder')!;
    expect(dropPlace(forest, target, 'inside')).toEqual({ parentId: 'Folder', index: 1 });
    expect(dropPlace(forest, target, 'before')).toEqual({ parentId: 'App', index: 1 });
    expect(dropPlace(forest, target, 'after')).toEqual({ parentId: 'App', index: 2 });
  });
});

describe('the kind that Add Object begins with', () => {
  const [folder, , pou] = RULES;
  it('is a POU where there may be one, unless another was asked for', () => {
    expect(firstChoice([folder!, pou!])).toBe(pou);
    expect(firstChoice([folder!, pou!], 'folder')).toBe(folder);
    expect(firstChoice([folder!])).toBe(folder);
  });
});
