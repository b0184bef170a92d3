import { describe, expect, it } from 'vitest';
import type { Library, LibraryItem } from '@/api/types';
import { blockPins, groupsOf, objectKindOf } from './model';

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
  removable: false,
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

  it('have the icons of objects', () => {
    expect(objectKindOf(item('E', 'enum'))).toEqual({ kind: 'dut', subkind: 'enum' });
    expect(objectKindOf(item('g', 'global')).kind).toBe('gvl');
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
