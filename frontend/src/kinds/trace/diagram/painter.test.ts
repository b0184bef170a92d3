import { describe, expect, it } from 'vitest';
import type { GraphType } from '../configuration';
import type { Curves } from '../data/curves';
import { bands, outline, type CurveLook } from './painter';
import type { Plane } from './plane';

/** One pixel for a nanosecond and a unit; up is less. */
const plane: Plane = { left: 0, top: 0, width: 200, height: 200, toX: (ns) => ns, toY: (value) => 100 - value };

function strokes(graph: GraphType, values: number[], gap: number[] = [], high: number[] = values): string {
  const curves: Curves = {
    step: high === values ? 1 : 10,
    time: Float64Array.from(values, (_, k) => 10 * k),
    gap: Uint8Array.from(values, (_, k) => gap[k] ?? 0),
    channels: new Map(),
  };
  let text = '';
  const pen = {
    moveTo: (x: number, y: number) => (text += ` M${x},${100 - y}`),
    lineTo: (x: number, y: number) => (text += ` L${x},${100 - y}`),
  };
  outline(pen, curves, { low: Float64Array.from(values), high: Float64Array.from(high) }, graph, plane, 2);
  return text.trim();
}

describe('graph types (TRC-42)', () => {
  it('join samples by lines, or go in steps', () => {
    expect(strokes('line', [1, 5, 3])).toBe('M0,1 L0.5,1 L10,5 L20,3');
    expect(strokes('step', [1, 5, 3])).toBe('M0,1 L0.5,1 L10,1 L10,5 L20,5 L20,3 L20,3');
    expect(strokes('none', [1, 5, 3])).toBe('');
  });

  it('fall to zero until the next sample as a saw', () => {
    expect(strokes('saw_tooth', [4, 6])).toBe('M0,4 L0.5,4 L10,0 M10,0 L10,6');
  });

  it('mark samples alone', () => {
    expect(strokes('points', [1, NaN, 3])).toBe('M-1,1 L1,1 M19,3 L21,3');
    expect(strokes('cross', [7])).toBe('M-2,9 L2,5 M-2,5 L2,9');
  });

  it('leave out what was not recorded (trace EX-04)', () => {
    expect(strokes('line', [1, 2, 3, 4], [0, 0, 1, 0])).toBe('M0,1 L0.5,1 L10,2 M20,3 L20.5,3 L30,4');
    expect(strokes('line', [1, NaN, 3])).toBe('M0,1 L0.5,1 M20,3 L20.5,3');
  });

  it('show minimum and maximum of many samples, without a zigzag', () => {
    expect(strokes('line', [0, 5], [], [4, 9])).toBe('M0,0 L0,4 L10,5 L10,9');
    expect(strokes('line', [5, 0], [], [9, 4])).toBe('M0,5 L0,9 L10,4 L10,0');
  });
});

describe('the colours of limits', () => {
  const look: CurveLook = {
    color: 'blue',
    graph: 'line',
    width: 1,
    minimum: { on: true, limit: -50, color: 'brown' },
    maximum: { on: true, limit: 100, color: 'red' },
  };
  const colorAt = (value: number, of: CurveLook, on = plane) =>
    bands(of, on).find(({ from, to }) => on.toY(value) > from && on.toY(value) < to)?.color;

  it('are those of the warning beyond the limit (trace EX-06)', () => {
    const wide = { ...plane, height: 400, toY: (value: number) => 200 - value };
    expect([101, 99, 0, -49, -51].map((value) => colorAt(value, look, wide))).toEqual([
      'red',
      'blue',
      'blue',
      'blue',
      'brown',
    ]);
    const turned = { ...wide, toY: (value: number) => 200 + value };
    expect([101, 99, -51].map((value) => colorAt(value, look, turned))).toEqual(['red', 'blue', 'brown']);
  });

  it('are not there while the warning is off, or its limit out of sight', () => {
    const off = { ...look, maximum: { ...look.maximum!, on: false }, minimum: null };
    expect(bands(off, plane)).toEqual([{ from: 0, to: 200, color: 'blue' }]);
    const far = { ...look, maximum: { ...look.maximum!, limit: 1e9 }, minimum: null };
    expect(bands(far, plane)).toEqual([{ from: 0, to: 200, color: 'blue' }]);
  });
});
