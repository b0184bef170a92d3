/** Arcs, ellipses and parabolas have the places and lengths of the specification (cnc EX-16, EX-20, EX-21). */
import { describe, expect, it } from 'vitest';
import { arcOfCentre, arcOfRadius, pointOn } from './arc';
import { curveOf, lengthOf } from './curve';
import { stepsOf } from './operations/refusal';
import { ORIGIN } from './state';

function parts(count: number): number[] {
  return Array.from({ length: count + 1 }, (_, at) => at / count);
}

describe('arcs', () => {
  it('cnc EX-16 (a), (b), (h), (i) as in the specification', () => {
    const a = arcOfRadius([100, 100], [200, 100], 50, true)!;
    expect(a.centre[0]).toBeCloseTo(150);
    expect(a.radius * Math.abs(a.sweep)).toBeCloseTo(157.0796, 4);
    expect(pointOn(a, 0.5)[1]).toBeCloseTo(150);
    expect(pointOn(arcOfRadius([100, 100], [200, 100], 50, false)!, 0.5)[1]).toBeCloseTo(50);
    const h = arcOfCentre([100, 100], [100, 100], [150, 100], true)!;
    expect(h.radius * Math.abs(h.sweep)).toBeCloseTo(314.1593, 4);
    const i = arcOfRadius([100, 100], [150, 150], 50, false)!;
    expect([i.centre[0], i.centre[1], i.radius * i.sweep].map((value) => Number(value.toFixed(4)))).toEqual([
      100, 150, 78.5398,
    ]);
  });
  it('cnc EX-20, EX-21 ellipses and parabolas have the lengths of the specification', () => {
    const length = (lines: string[]) => {
      const { block: last, state, after, code } = stepsOf(lines, ORIGIN, []).at(-1)!;
      return lengthOf(curveOf(last, state, after, code!)!);
    };
    expect(length(['G92 X100 Y0', 'G98', 'G9 X0 Y50 I0 J0 K0'])).toBeCloseTo(121.1056, 3);
    expect(length(['G0 X100 Y200', 'G98', 'G6 X-100 Y200 I0 J0 F100'])).toBeCloseTo(464.678, 2);
    const {
      block: last,
      state,
      after,
    } = stepsOf(['G0 X100 Y100', 'G98', 'G8 X200 Y100 I150 J100 K45 R0.5'], ORIGIN, []).at(-1)!;
    const far = parts(400)
      .map(curveOf(last, state, after, 8)!)
      .map(([x, y]) => Math.hypot(x - 150, y - 100));
    expect(Math.max(...far)).toBeCloseTo(79.0569, 2);
    expect(Math.min(...far)).toBeCloseTo(39.5285, 2);
  });
  it('GEO-05 GEO-06 of impossible values are none', () => {
    expect(arcOfRadius([100, 100], [200, 100], 40, true)).toBeNull();
    expect(arcOfCentre([0, 0], [10, 0], [3, 0], true)).toBeNull();
    expect(arcOfCentre([0, 0], [10, 0], [5.2, 0], true)!.centre[0]).toBeCloseTo(5);
  });
});
