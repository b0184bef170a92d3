import { describe, expect, it } from 'vitest';
import type { Library, LibraryItem } from '@/api/types';
import { blockPins, groupsOf, libraryFaults, nextVersion } from './model';

const item = (name: string, kind: string, more: Partial<LibraryItem> = {}): LibraryItem => ({
  name,
  kind,
  summary: '',
  methods: [],
  inputs: [],
  outputs: [],
  in_out: [],
  members: [],
  values: [],
  returns: null,
  ...more,
});
const pin = (name: string) => ({ name, type: 'BOOL', default: '', comment: '' });
const library = (items: LibraryItem[]): Library => ({
  name: 'L',
  version: '1',
  namespace: 'L',
  company: '',
  description: '',
  qualified_only: false,
  removable: false,
  requires: [],
  replaces: [],
  items,
});

describe('library contents', () => {
  it('stand in folders by kind, by name within', () => {
    const groups = groupsOf(
      library([item('Z', 'function_block'), item('E', 'enum'), item('A', 'function_block'), item('S', 'struct')]),
    );
    expect(groups.map((group) => [group.group, group.items.map((one) => one.name)])).toEqual([
      ['function_block', ['A', 'Z']],
      ['data', ['E', 'S']],
    ]);
  });

  it('are found by name and comment', () => {
    const groups = groupsOf(
      library([item('TON', 'function_block', { summary: 'on delay' }), item('TOF', 'function_block')]),
      'DELAY',
    );
    expect(groups.flatMap((group) => group.items.map((one) => one.name))).toEqual(['TON']);
  });
});

describe('pins', () => {
  it('of in/outs stand at both sides, before the others', () => {
    const pins = blockPins(
      item('MC_Power', 'function_block', { inputs: [pin('Enable')], outputs: [pin('Status')], in_out: [pin('Axis')] }),
    );
    expect(pins.left.map((one) => one.name)).toEqual(['Axis', 'Enable']);
    expect(pins.right.map((one) => one.name)).toEqual(['Axis', 'Status']);
  });

  it('of a function begin with its result', () => {
    expect(blockPins(item('LEN', 'function', { returns: 'INT' })).right).toEqual([{ name: 'LEN', type: 'INT' }]);
  });
});

describe('a library to be saved', () => {
  const installed = [
    { name: 'Plant', version: '1.9.0.0', removable: true },
    { name: 'Plant', version: '1.10.0.3', removable: true },
    { name: 'Util', version: '1.0', removable: false },
  ];

  it('gets the next version of its name', () => {
    expect(nextVersion('Plant', installed)).toBe('1.10.0.4');
    expect(nextVersion('Other', installed)).toBe('1.0.0.0');
  });

  it('has a name, a version and a namespace that can be', () => {
    const facts = { name: 'Plant', version: '1.10.0.3', namespace: '' };
    expect(libraryFaults(facts, installed)).toEqual({ name: null, version: null, namespace: null });
    expect(libraryFaults({ name: '2x', version: 'one', namespace: 'a b' }, installed)).toEqual({
      name: 'libraries.nameFault',
      version: 'libraries.versionFault',
      namespace: 'library.namespaceFault',
    });
    expect(libraryFaults({ name: 'util', version: '1.0', namespace: '' }, installed).version).toBe('libraries.stays');
  });
});
