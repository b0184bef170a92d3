/** Acts on points and segments; numbers of cam EX-01, EX-02, EX-03, EX-04, EX-05 and EX-07. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { domainOf, LAWS, segmentAt, type CamTable } from './camTable';
import { endsOfLaw, heldAt } from './consistency';
import { deletePoint, insertPoint, middleOf, movePoint, placeFor, setLaw, setPeriod, setRange } from './points';
import { camRows, rowOf } from './rows';
import { anyCam, DEFAULT_CAM, poly5 } from './sampleCam';

const lawful = (cam: CamTable) => {
  expect(cam.segments).toHaveLength(cam.points.length - 1);
  cam.points.forEach((point, at) => {
    if (at > 0) expect(point.x - cam.points[at - 1]!.x).toBeGreaterThanOrEqual(1e-9);
    Object.values(point).forEach((value) => expect(Number.isFinite(value)).toBe(true));
  });
};
const inCam = (cam: CamTable, x: number) => {
  const at = segmentAt(cam, x);
  return poly5(cam.points[at]!, cam.points[at + 1]!, x);
};

describe('a point', () => {
  it('inserted on the curve leaves it as it is (cam EX-03)', () => {
    const values = inCam(DEFAULT_CAM, 60);
    expect(values.y).toBeCloseTo(41.25, 12);
    expect(values.v).toBeCloseTo(1.4375, 12);
    const { cam, index } = insertPoint(DEFAULT_CAM, middleOf(DEFAULT_CAM, 0), values);
    expect(index).toBe(1);
    expect(cam.points[1]!).toMatchObject({ x: 60, a: expect.closeTo(0.0125, 12) as number });
    for (let x = 0; x <= 360; x += 7) expect(inCam(cam, x).y).toBeCloseTo(inCam(DEFAULT_CAM, x).y, 9);
    expect(deletePoint(cam, 1)).toEqual(DEFAULT_CAM);
  });

  it('deleted joins its segments (cam EX-04)', () => {
    const cam = deletePoint(DEFAULT_CAM, 1);
    expect(cam.points).toHaveLength(3);
    const { y, v, a } = inCam(cam, 120);
    expect([y, v, a]).toEqual([82.5, 1.4375, 0.00625].map((value) => expect.closeTo(value, 10) as number));
    expect(deletePoint(cam, 0)).toBe(cam);
    expect(deletePoint(cam, 2)).toBe(cam);
  });

  it('moves between its neighbours only; start and end keep X (CAM-36)', () => {
    expect(movePoint(DEFAULT_CAM, 1, { x: 130, y: 5, v: -1, a: 2 }).points[1]).toEqual({
      x: 130,
      y: 5,
      v: -1,
      a: 2,
      j: 0,
    });
    expect(movePoint(DEFAULT_CAM, 1, { x: 500 }).points[1]!.x).toBeCloseTo(240, 2);
    expect(movePoint(DEFAULT_CAM, 1, { x: 500 }).points[1]!.x).toBeLessThan(240);
    expect(movePoint(DEFAULT_CAM, 0, { x: 5, y: 6 }).points[0]).toMatchObject({ x: 0, y: 6 });
    expect(movePoint(DEFAULT_CAM, 3, { x: 300 }).points[3]!.x).toBe(360);
  });

  it('has no place where the segment is too narrow', () => {
    expect(placeFor(DEFAULT_CAM, 120)).toBeGreaterThan(120);
    expect(placeFor(DEFAULT_CAM, 360)).toBeLessThan(360);
    expect(placeFor(movePoint(DEFAULT_CAM, 1, { x: 239.9999 }), 239.99995)).toBeNull();
  });
});

describe('the type of a segment', () => {
  it('changes nothing where the line fits already (cam EX-05)', () => {
    expect(setLaw(DEFAULT_CAM, 1, 'line').points).toEqual(DEFAULT_CAM.points);
  });

  it('gives V and A of a line to neighbours that take any (CAM-47, cam EX-02)', () => {
    const points = [
      { x: 0, y: 0 },
      { x: 140, y: 100 },
      { x: 280, y: 180 },
      { x: 360, y: 140 },
    ].map((point) => ({ ...point, v: 0, a: 3, j: 0 }));
    const cam = setLaw(setLaw({ ...DEFAULT_CAM, points }, 0, 'line'), 2, 'line');
    expect(cam.points.map((point) => point.v)).toEqual([100 / 140, 100 / 140, -0.5, -0.5]);
    expect(cam.points.map((point) => point.a)).toEqual([0, 0, 0, 0]);
    expect(inCam(cam, 210).y).toBeCloseTo(166.5625, 10);
    expect(inCam(cam, 245).y).toBeCloseTo(188.447266, 6);
    // A moved end of the line turns it, and the neighbour follows.
    expect(movePoint(cam, 0, { y: 30 }).points[1]!.v).toBeCloseTo(0.5, 12);
    // What the line gives cannot be typed.
    expect(movePoint(cam, 1, { v: 9 }).points[1]!.v).toBe(100 / 140);
    expect(heldAt(cam, 1, 'v')).toBe(100 / 140);
    expect(heldAt(DEFAULT_CAM, 1, 'v')).toBeNull();
  });

  it('has ends that are those of the curve of VDI 2143', () => {
    const [left, right] = [DEFAULT_CAM.points[1]!, { ...DEFAULT_CAM.points[2]!, v: 0.25 }];
    // Cubic Hermite: the second derivative by differences of the interpolation.
    const h = 120;
    const at = (s: number) =>
      120 * (2 * s ** 3 - 3 * s ** 2 + 1) +
      h * (s ** 3 - 2 * s ** 2 + s) +
      240 * (3 * s ** 2 - 2 * s ** 3) +
      0.25 * h * (s ** 3 - s ** 2);
    const e = 1e-3;
    const [begin, end] = endsOfLaw('poly3', left, right);
    expect(begin.a).toBeCloseTo((at(0) - 2 * at(e) + at(2 * e)) / (e * h) ** 2, 4);
    expect(end.a).toBeCloseTo((at(1) - 2 * at(1 - e) + at(1 - 2 * e)) / (e * h) ** 2, 3);
    // Y = Y0 + rise (1 - cos(pi s)) / 2
    expect(endsOfLaw('sine', left, right)[0].a).toBeCloseTo((120 / 2) * (Math.PI / 120) ** 2, 12);
  });
});

describe('a periodic cam', () => {
  const start = movePoint(setPeriod(DEFAULT_CAM, { periodic: true }), 0, { v: 0.5 });

  it('keeps whole periods between its ends, which share V and A (cam EX-07)', () => {
    expect(start.points[3]).toMatchObject({ y: 360, v: 0.5, a: 0 });
    expect(movePoint(start, 3, { y: 720 }).points[3]).toMatchObject({ y: 720, v: 0.5, a: 0 });
    expect(movePoint(start, 3, { y: 100 }).points[3]!.y).toBe(0);
    expect(movePoint(start, 3, { y: 190 }).points[3]!.y).toBe(360);
    expect(movePoint(start, 3, { v: -2, a: 1 }).points[0]).toMatchObject({ y: 0, v: -2, a: 1 });
    expect(movePoint(start, 0, { y: 1000 }).points[3]!.y).toBe(1360);
  });

  it('takes V of a line at one of its ends', () => {
    const cam = setLaw(start, 2, 'line');
    expect(cam.points[3]!.v).toBe(1);
    expect(cam.points[0]!.v).toBe(1);
    expect(movePoint(cam, 0, { v: 7 }).points[0]!.v).toBe(1);
  });
});

describe('another range of the master', () => {
  it('moves the ends and removes what is outside (CAM-71)', () => {
    const longer = setRange(DEFAULT_CAM, 0, 400);
    expect(longer).toMatchObject({ points: 0, tappets: 0 });
    expect(longer.cam.points[3]).toMatchObject({ x: 400, y: 360 });
    const shorter = setRange(setLaw(DEFAULT_CAM, 2, 'line'), 100, 200);
    expect(shorter).toMatchObject({ points: 1, tappets: 2 });
    expect(shorter.cam.points.map((point) => point.x)).toEqual([100, 120, 200]);
    expect(shorter.cam.segments.map((segment) => segment.law)).toEqual(['poly5', 'poly5']);
    expect(setRange(DEFAULT_CAM, 1000, 1001).cam.points.map((point) => point.x)).toEqual([1000, 1001]);
  });
});

describe('any cam', () => {
  const pick = fc.nat(1000);

  it('stays a cam whatever is done to it', () => {
    fc.assert(
      fc.property(anyCam, pick, pick, fc.double({ min: -1e4, max: 1e4, noNaN: true }), (cam, one, other, number) => {
        const index = one % cam.points.length;
        const segment = other % cam.segments.length;
        const law = LAWS[one % LAWS.length]!;
        const place = placeFor(cam, middleOf(cam, segment))!;
        const acts = [
          insertPoint(cam, place, { y: number, v: number, a: number, j: 0 }).cam,
          movePoint(cam, index, { x: number, y: number }),
          deletePoint(cam, index),
          setLaw(cam, segment, law),
          setRange(cam, number, number + 1 + one).cam,
          setPeriod(cam, { periodic: !cam.periodic }),
        ];
        acts.forEach(lawful);
        acts.forEach((after) => {
          if (after === cam || !after.periodic) return;
          const [first, last] = [after.points[0]!, after.points[after.points.length - 1]!];
          // An act on a periodic cam leaves it one; its start and end share what no segment fixes otherwise.
          const turns = (last.y - first.y) / after.slave_period;
          expect(Math.abs(turns - Math.round(turns))).toBeLessThan(1e-9);
        });
      }),
    );
  });

  it('has rows that are points and segments in turn (CAM-40)', () => {
    fc.assert(
      fc.property(anyCam, (cam) => {
        const rows = camRows(cam);
        expect(rows).toHaveLength(2 * cam.points.length - 1);
        rows.forEach((row, at) => {
          expect(row.kind).toBe(at % 2 ? 'segment' : 'point');
          expect(rowOf(row)).toBe(at);
        });
      }),
    );
  });

  it('gets back what an inserted and deleted point took, where all is Poly5', () => {
    fc.assert(
      fc.property(anyCam, pick, (any, at) => {
        const cam = {
          ...any,
          periodic: false,
          segments: any.segments.map(() => ({ law: 'poly5' as const, inflection: 0.5 })),
        };
        const x = placeFor(cam, middleOf(cam, at % cam.segments.length))!;
        const inserted = insertPoint(cam, x, inCam(cam, x));
        expect(domainOf(inserted.cam)).toEqual(domainOf(cam));
        expect(deletePoint(inserted.cam, inserted.index)).toEqual(cam);
      }),
    );
  });
});
