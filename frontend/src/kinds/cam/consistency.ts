/**
 * What follows for the points from the types of the segments and from the period (CAM-44, CAM-47, CAM-72).
 * A law that leaves no choice of V or A at its ends gives them to a neighbour that takes any. Pure functions.
 */
import { replaced, type CamPoint, type CamTable, type Law } from './camTable';

interface End {
  v?: number;
  a?: number;
}

const HALF_PI_SQUARED = Math.PI ** 2 / 2;

/** V and A that the law itself has at its ends, whatever the points say; formulas of cam.md section 1 and VDI 2143. */
export function endsOfLaw(law: Law, left: CamPoint, right: CamPoint): readonly [End, End] {
  const width = right.x - left.x;
  const slope = (right.y - left.y) / width;
  switch (law) {
    case 'line':
      return [
        { v: slope, a: 0 },
        { v: slope, a: 0 },
      ];
    case 'poly3':
      return [
        { a: (6 * slope - 4 * left.v - 2 * right.v) / width },
        { a: (2 * left.v + 4 * right.v - 6 * slope) / width },
      ];
    case 'sine': {
      const a = (HALF_PI_SQUARED * slope) / width;
      return [
        { v: 0, a },
        { v: 0, a: -a },
      ];
    }
    case 'inclined_sine':
      return [
        { v: 0, a: 0 },
        { v: 0, a: 0 },
      ];
    case 'modified_sine':
      return [{ a: 0 }, { a: 0 }];
    case 'poly5':
    case 'poly7':
    case 'harmonic':
      return [{}, {}];
  }
}

/** What the segments at both sides of a point give it. */
function givenAt(cam: CamTable, index: number): readonly [End | null, End | null] {
  const point = cam.points[index]!;
  const before = cam.points[index - 1];
  const behind = cam.points[index + 1];
  return [
    before ? endsOfLaw(cam.segments[index - 1]!.law, before, point)[1] : null,
    behind ? endsOfLaw(cam.segments[index]!.law, point, behind)[0] : null,
  ];
}

/** The value of V or A that a segment gives the point, so that it cannot be typed; null where it is free. */
export function heldAt(cam: CamTable, index: number, name: 'v' | 'a'): number | null {
  const [left, right] = givenAt(cam, index);
  return right?.[name] ?? left?.[name] ?? null;
}

/** Gives the points from `first` to `last` the V and A that the segments beside them leave no choice of. */
function takeFromLaws(cam: CamTable, first: number, last: number): CamTable {
  const points = [...cam.points];
  // A of a cubic segment follows from V at its ends: all V first.
  for (const name of ['v', 'a'] as const)
    for (let index = Math.max(0, first); index <= Math.min(points.length - 1, last); index++) {
      const held = heldAt({ ...cam, points }, index, name);
      if (held !== null) points[index] = { ...points[index]!, [name]: held + 0 };
    }
  return { ...cam, points };
}

/** The whole number of periods that the end lies away from the start. */
function turnsOf(cam: CamTable): number {
  return Math.round((cam.points[cam.points.length - 1]!.y - cam.points[0]!.y) / cam.slave_period);
}

/**
 * Lets the end of a periodic cam go over into its start (CAM-72): the end lies whole periods away, V and A are those of
 * the `lead`, unless a segment gives them at the other end.
 */
function closePeriod(cam: CamTable, lead: 'start' | 'end', turns: number): CamTable {
  const at = cam.points.length - 1;
  const start = cam.points[0]!;
  const end = cam.points[at]!;
  const common = (name: 'v' | 'a') =>
    heldAt(cam, 0, name) ?? heldAt(cam, at, name) ?? (lead === 'start' ? start : end)[name];
  const shared = { v: common('v'), a: common('a') };
  const points = replaced(cam.points, 0, { ...start, ...shared });
  return { ...cam, points: replaced(points, at, { ...end, ...shared, y: start.y + turns * cam.slave_period }) };
}

/** A cam after a change of the points from `first` to `last` or of what lies between them. */
export function settled(before: CamTable, cam: CamTable, first: number, last: number): CamTable {
  const free = takeFromLaws(cam, first - 1, last + 1);
  if (!cam.periodic) return free;
  const at = cam.points.length - 1;
  const endLeads = last >= at && first > 0;
  const turns = endLeads || !before.periodic ? turnsOf(free) : turnsOf(before);
  const closed = closePeriod(free, endLeads ? 'end' : 'start', turns);
  // The other end may have moved: what hangs on it follows.
  return takeFromLaws(takeFromLaws(closed, 0, 1), at - 1, at);
}
