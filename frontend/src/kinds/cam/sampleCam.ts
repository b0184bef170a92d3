/** Cams for tests: the default one, and any with whatever is allowed in it. */
import fc from 'fast-check';
import { LAWS, type CamPoint, type CamTable, type Values } from './camTable';
import { ACTIONS } from './tappets';

const point = (x: number, y: number, v = 0, a = 0): CamPoint => ({ x, y, v, a, j: 0 });

export const DEFAULT_CAM: CamTable = {
  exclude_from_build: false,
  points: [point(0, 0), point(120, 120, 1), point(240, 240, 1), point(360, 360)],
  segments: [1, 2, 3].map(() => ({ law: 'poly5', inflection: 0.5 })),
  tracks: [
    {
      id: 1,
      tappets: [
        { x: 90, positive: 'on', negative: 'off' },
        { x: 270, positive: 'on', negative: 'off' },
      ],
    },
    { id: 2, tappets: [] },
  ],
  slave_start: 0,
  slave_end: 360,
  periodic: false,
  slave_period: 360,
  checks: { velocity: true, acceleration: true, jerk: false },
  compile_format: 'polynomial',
  table_size: 256,
  cubic: false,
};

const value = fc.integer({ min: -5000, max: 5000 }).map((number) => number / 10);

/** Any cam of 2 to 8 points, with tappets in its range. */
export const anyCam: fc.Arbitrary<CamTable> = fc
  .record({
    widths: fc.array(fc.integer({ min: 1, max: 900 }), { minLength: 1, maxLength: 7 }),
    start: value,
    states: fc.array(fc.tuple(value, value, value), { minLength: 8, maxLength: 8 }),
    laws: fc.array(fc.constantFrom(...LAWS), { minLength: 7, maxLength: 7 }),
    tracks: fc.array(
      fc.array(
        fc.tuple(fc.double({ min: 0, max: 1, noNaN: true }), fc.constantFrom(...ACTIONS), fc.constantFrom(...ACTIONS)),
        {
          maxLength: 4,
        },
      ),
      { maxLength: 3 },
    ),
    periodic: fc.boolean(),
  })
  .map(({ widths, start, states, laws, tracks, periodic }) => {
    const xs = [start];
    widths.forEach((width) => xs.push(xs[xs.length - 1]! + width / 10));
    const last = xs[xs.length - 1]!;
    return {
      ...DEFAULT_CAM,
      points: xs.map((x, at) => point(x, ...states[at]!)),
      segments: widths.map((_, at) => ({ law: laws[at]!, inflection: 0.5 })),
      tracks: tracks.map((tappets, at) => ({
        id: at + 1,
        tappets: tappets
          .map(([part, positive, negative]) => ({
            x: Math.min(last, start + part * (last - start)),
            positive,
            negative,
          }))
          .sort((a, b) => a.x - b.x),
      })),
      periodic,
    };
  });

/** Values of a segment of type Poly5, by the formulas of cam.md section 1. */
export function poly5(left: CamPoint, right: CamPoint, x: number): Values {
  const h = right.x - left.x;
  const s = (x - left.x) / h;
  const rise = right.y - left.y;
  const [v0, v1, a0, a1] = [left.v * h, right.v * h, left.a * h * h, right.a * h * h];
  const c = [
    left.y,
    v0,
    a0 / 2,
    10 * rise - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1,
    -15 * rise + 8 * v0 + 7 * v1 + 1.5 * a0 - a1,
    6 * rise - 3 * v0 - 3 * v1 - 0.5 * a0 + 0.5 * a1,
  ];
  const derivative = (order: number) =>
    c.reduce((sum, factor, power) => {
      let product = factor;
      for (let step = 0; step < order; step++) product *= power - step;
      return power < order ? sum : sum + product * s ** (power - order);
    }, 0) /
    h ** order;
  return { y: derivative(0), v: derivative(1), a: derivative(2), j: derivative(3) };
}
