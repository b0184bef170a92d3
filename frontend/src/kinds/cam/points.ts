/** Acts on points and segments of a cam (CAM-35 to CAM-37, CAM-43 to CAM-47, CAM-71, CAM-72): a cam to another. Pure. */
import {
  domainOf,
  isEnd,
  replaced,
  roomOf,
  segmentAt,
  within,
  leastWidth,
  type CamPoint,
  type CamSegment,
  type CamTable,
  type Law,
  type Values,
} from './camTable';
import { settled } from './consistency';

const POLY5: CamSegment = { law: 'poly5', inflection: 0.5 };

/** Where a point can be inserted next to an X, or null where the segment is too narrow. */
export function placeFor(cam: CamTable, x: number): number | null {
  const segment = segmentAt(cam, x);
  const width = leastWidth(cam);
  const least = cam.points[segment]!.x + width;
  const greatest = cam.points[segment + 1]!.x - width;
  return least <= greatest ? within(x, [least, greatest]) : null;
}

/** The middle of a segment, where the table inserts (CAM-43). */
export function middleOf(cam: CamTable, segment: number): number {
  return (cam.points[segment]!.x + cam.points[segment + 1]!.x) / 2;
}

/**
 * Splits the segment at `x`, strictly inside it, into two of type Poly5 (CAM-35); `values` are those of the old curve, except what
 * the mouse gave. Returns the index of the new point, too.
 */
export function insertPoint(cam: CamTable, x: number, values: Values): { cam: CamTable; index: number } {
  const segment = segmentAt(cam, x);
  const index = segment + 1;
  const points = [...cam.points.slice(0, index), { x, ...values, j: 0 }, ...cam.points.slice(index)];
  const segments = [...cam.segments.slice(0, segment), POLY5, POLY5, ...cam.segments.slice(index)];
  return { cam: settled(cam, { ...cam, points, segments }, index, index), index };
}

/** Moves a point or changes its derivatives (CAM-36); X stays between the neighbours, start and end keep it. */
export function movePoint(cam: CamTable, index: number, changes: Partial<CamPoint>): CamTable {
  const point = cam.points[index]!;
  const next = { ...point, ...changes, x: within(changes.x ?? point.x, roomOf(cam, index)) };
  return settled(cam, { ...cam, points: replaced(cam.points, index, next) }, index, index);
}

/** Deletes a point; the segments beside it become one of type Poly5 (CAM-37). Start and end stay. */
export function deletePoint(cam: CamTable, index: number): CamTable {
  if (isEnd(cam, index)) return cam;
  const points = cam.points.filter((_, at) => at !== index);
  const segments = [...cam.segments.slice(0, index - 1), POLY5, ...cam.segments.slice(index + 1)];
  return settled(cam, { ...cam, points, segments }, index - 1, index);
}

/** Gives a segment another law of motion; V and A at its borders follow (CAM-47). */
export function setLaw(cam: CamTable, segment: number, law: Law): CamTable {
  return changeSegment(cam, segment, { law });
}

/** The part of a modified sine in front of its inflection point, more than 0 and less than 1. */
export function setInflection(cam: CamTable, segment: number, inflection: number): CamTable {
  return changeSegment(cam, segment, { inflection });
}

function changeSegment(cam: CamTable, segment: number, changes: Partial<CamSegment>): CamTable {
  const segments = replaced(cam.segments, segment, { ...cam.segments[segment]!, ...changes });
  return settled(cam, { ...cam, segments }, segment, segment + 1);
}

/** Switches the periodic transition, or changes its period (CAM-72): the end follows the start. */
export function setPeriod(cam: CamTable, changes: Partial<Pick<CamTable, 'periodic' | 'slave_period'>>): CamTable {
  const next = { ...cam, ...changes };
  return next.periodic ? settled({ ...next, periodic: false }, next, 0, 0) : next;
}

export interface NewRange {
  cam: CamTable;
  /** How many points and tappets lie outside and are lost. */
  points: number;
  tappets: number;
}

/** Another range of the master (CAM-71): start and end move there, what lies outside is removed. `first` lies below `last`. */
export function setRange(cam: CamTable, first: number, last: number): NewRange {
  const [oldFirst, oldLast] = domainOf(cam);
  const width = Math.max(leastWidth(cam), (last - first) * 1e-6);
  const kept = (index: number) =>
    isEnd(cam, index) || (cam.points[index]!.x > first + width && cam.points[index]!.x < last - width);
  const points: CamPoint[] = [];
  const segments: CamSegment[] = [];
  cam.points.forEach((point, index) => {
    if (!kept(index)) return;
    // The segment in front of a kept point; where points between are gone, one of type Poly5.
    if (points.length > 0) segments.push(kept(index - 1) ? cam.segments[index - 1]! : POLY5);
    points.push(point.x === oldFirst ? { ...point, x: first } : point.x === oldLast ? { ...point, x: last } : point);
  });
  const tracks = cam.tracks.map((track) => ({
    ...track,
    tappets: track.tappets.filter((tappet) => tappet.x >= first && tappet.x <= last),
  }));
  const count = (of: CamTable['tracks']) => of.reduce((sum, track) => sum + track.tappets.length, 0);
  const next = { ...cam, points, segments, tracks };
  return {
    cam: settled(cam, settled(cam, next, 0, 1), points.length - 2, points.length - 1),
    points: cam.points.length - points.length,
    tappets: count(cam.tracks) - count(tracks),
  };
}
