import { describe, expect, it } from 'vitest';
import {
  changeChannels,
  faultsOf,
  newChannel,
  newRecord,
  nodesBetween,
  recordedPart,
  recordedSpan,
  withoutNodes,
  withVariables,
  type TraceData,
} from './configuration';

const EMPTY: TraceData = { refresh_rate: 500, points: 10_000, stacked: false, records: [] };
const two: TraceData = {
  ...EMPTY,
  records: [
    { ...newRecord([]), channels: [newChannel('a'), newChannel('b')] },
    { ...newRecord([newRecord([])]), channels: [newChannel('a')] },
  ],
};
const names = (data: TraceData) => data.records.map(({ name, channels }) => [name, ...channels.map((c) => c.variable)]);
const faults = (data: TraceData) =>
  faultsOf(data).map(({ node, field, key }) => [node?.record, node?.channel, field, key]);

describe('records and variables', () => {
  it('are added, each variable once in a record (TRC-30)', () => {
    expect(names(withVariables(EMPTY, 0, ['PLC_PRG.x']))).toEqual([['Record1', 'PLC_PRG.x']]);
    expect(names(withVariables(two, 1, ['A', 'c', ' c ', '']))).toEqual([
      ['Record1', 'a', 'b'],
      ['Record2', 'a', 'c'],
    ]);
  });

  it('are deleted, a record with what is in it', () => {
    expect(
      names(
        withoutNodes(two, [
          { record: 0, channel: null },
          { record: 1, channel: 0 },
        ]),
      ),
    ).toEqual([['Record2']]);
  });

  it('are chosen from one to another and changed together', () => {
    const nodes = nodesBetween(two, { record: 1, channel: 0 }, { record: 0, channel: 1 });
    expect(nodes.map(({ record, channel }) => [record, channel])).toEqual([
      [0, 1],
      [1, null],
      [1, 0],
    ]);
    const changed = changeChannels(two, nodes, (channel) => ({ ...channel, color: '#123456' }));
    expect(changed.records.map(({ channels }) => channels.map(({ color }) => color))).toEqual([
      ['', '#123456'],
      ['#123456'],
    ]);
  });

  it('hold as long as buffer, cycles and task say (trace EX-02)', () => {
    expect(recordedSpan({ buffer: 100, every: 1 }, 10e6)).toBe(1e9);
    expect(recordedSpan({ buffer: 500, every: 2 }, 4e6)).toBe(4e9);
  });
});

describe('faults', () => {
  it('are none in what is new', () => {
    expect(faults(EMPTY)).toEqual([]);
    expect(faults(two)).toEqual([]);
  });

  it('have their place', () => {
    const [record] = two.records;
    const x = { ...record!.appearance.x, minimum: 'T#5s', maximum: 'T#1s', major: '2s' };
    const broken: TraceData = {
      ...two,
      refresh_rate: 1,
      records: [
        {
          ...record!,
          every: 0,
          trigger: { ...record!.trigger, edge: 'positive' },
          appearance: { ...record!.appearance, x },
          channels: [newChannel('a'), newChannel(' A'), newChannel(''), { ...newChannel(), formula: 'a +' }],
        },
        { ...two.records[1]!, name: 'record1' },
      ],
    };
    expect(faults(broken)).toEqual([
      [undefined, undefined, 'refresh_rate', 'trace.fault.number'],
      [0, null, 'every', 'trace.fault.number'],
      [0, null, 'trigger.variable', 'trace.fault.triggerVariable'],
      [0, null, 'x.maximum', 'trace.fault.order'],
      [0, null, 'x.major', 'trace.fault.time'],
      [0, 1, 'variable', 'trace.fault.twice'],
      [0, 2, 'variable', 'trace.fault.variable'],
      [0, 3, 'formula', 'trace.fault.formula.end'],
      [1, null, 'name', 'trace.fault.nameTwice'],
    ]);
  });

  it('tell a formula what channels there are', () => {
    const [record] = two.records;
    const with_ = (formula: string) => ({
      ...EMPTY,
      records: [{ ...record!, channels: [...record!.channels, { ...newChannel(), formula }] }],
    });
    expect(faults(with_('A - b'))).toEqual([]);
    expect(faultsOf(with_('a - c')).map(({ key, values }) => [key, values])).toEqual([
      ['trace.fault.formula.channel', { name: 'c' }],
    ]);
  });

  it('refuse a formula over a formula, whose values are not recorded', () => {
    const [record] = two.records;
    const twice = { ...newChannel(), name: 'twice', formula: 'a * 2' };
    const over = { ...newChannel(), formula: 'twice + 1' };
    const data = { ...EMPTY, records: [{ ...record!, channels: [...record!.channels, twice, over] }] };
    expect(faultsOf(data).map(({ key, values }) => [key, values])).toEqual([
      ['trace.fault.formula.channel', { name: 'twice' }],
    ]);
  });
});

describe('a download', () => {
  it('is needed after a change of what is recorded, not of how it looks (trace EX-07)', () => {
    const all = [{ record: 0, channel: 0 }];
    const changed = (change: Parameters<typeof changeChannels>[2]) => recordedPart(changeChannels(two, all, change));
    const now = recordedPart(two);
    expect(changed((channel) => ({ ...channel, color: '#ff0000', graph: 'step', visible: false, name: 'x' }))).toBe(
      now,
    );
    expect(changed((channel) => ({ ...channel, variable: 'c' }))).not.toBe(now);
    expect(recordedPart(withVariables(two, 0, ['c']))).not.toBe(now);
    expect(recordedPart({ ...two, refresh_rate: 100, stacked: true })).toBe(now);
    const formula = { ...newChannel(), formula: 'a + b' };
    const [record] = two.records;
    const more = { ...two, records: [{ ...record!, channels: [...record!.channels, formula] }, two.records[1]!] };
    expect(recordedPart(more)).toBe(now);
  });
});
