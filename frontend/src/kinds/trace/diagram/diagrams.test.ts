import { describe, expect, it } from 'vitest';
import { newChannel, newRecord, USUAL_VALUE_AXIS, type TraceData } from '../configuration';
import { diagramsOf, rowsOf } from './diagrams';

const own = { ...USUAL_VALUE_AXIS, maximum: 7 };
const data: TraceData = {
  refresh_rate: 500,
  points: 10_000,
  stacked: false,
  records: [
    {
      ...newRecord([]),
      channels: [newChannel('a', own), { ...newChannel('b'), visible: false }, { ...newChannel('c', own), axis: 1 }],
    },
    newRecord([newRecord([])]),
  ],
};

describe('the diagrams', () => {
  it('are one a record, with the appearance of the record (TRC-62)', () => {
    const [first, second] = diagramsOf(data, false, []);
    expect([first!.title, first!.channels, second!.channels]).toEqual(['Record1', [0, 2], []]);
    expect([...first!.y]).toEqual([
      [0, USUAL_VALUE_AXIS],
      [1, own],
    ]);
    expect([...second!.y]).toEqual([[0, USUAL_VALUE_AXIS]]);
  });

  it('are one a visible variable, with its own appearance, as multi-channel', () => {
    const found = diagramsOf(data, true, []);
    expect(found.map(({ key, title }) => [key, title])).toEqual([
      ['0.0', 'a'],
      ['0.2', 'c'],
    ]);
    expect([...found[0]!.y]).toEqual([[0, own]]);
    expect([...found[1]!.y]).toEqual([[1, own]]);
  });

  it('have what is computed behind those of the record', () => {
    const computed = [
      { record: 0, channel: 2, operation: 'derivative' as const },
      { record: 0, channel: 9, operation: 'integral' as const },
    ];
    expect(diagramsOf(data, false, computed).map(({ key }) => key)).toEqual(['0', '0.2.derivative', '1']);
  });

  it('stand one above another or three in a row (TRC-12)', () => {
    const four = Array.from({ length: 4 }, () => diagramsOf(data, false, [])[0]!);
    expect(rowsOf(four, false).map((row) => row.length)).toEqual([3, 1]);
    expect(rowsOf(four, true).map((row) => row.length)).toEqual([1, 1, 1, 1]);
    expect(rowsOf([], false)).toEqual([]);
  });
});
