/** A cam as the server keeps it, and what may stand in it (cam.md, sections 1, 6 and 8). Pure functions. */
import type { Schemas } from '@/api/types';

export type CamTable = Schemas['CamTable-Output'];
export type CamPoint = CamTable['points'][number];
export type CamSegment = CamTable['segments'][number];
export type CamTrack = CamTable['tracks'][number];
export type CamTappet = CamTrack['tappets'][number];
export type Law = CamSegment['law'];
export type TappetAction = CamTappet['positive'];

/** Position of the slave and its derivatives by the position of the master. */
export interface Values {
  y: number;
  v: number;
  a: number;
  j: number;
}

/** Largest position or derivative; that of the server. */
export const FARTHEST = 1e12;
/** Width of a segment at least; the server takes 1e-9, and nobody sees less than a part of the range. */
const NARROWEST = 1e-9;
const NARROWEST_PART = 1e-6;

export const LAWS: readonly Law[] = [
  'poly5',
  'line',
  'poly3',
  'poly7',
  'sine',
  'inclined_sine',
  'modified_sine',
  'harmonic',
];

/** First and last position of the master. */
export function domainOf(cam: CamTable): readonly [number, number] {
  return [cam.points[0]!.x, cam.points[cam.points.length - 1]!.x];
}

/** Least distance of two points that an act of the editor makes. */
export function leastWidth(cam: CamTable): number {
  const [first, last] = domainOf(cam);
  return Math.max(NARROWEST, (last - first) * NARROWEST_PART);
}

/** Whether a point is the start or the end of the range of the master, which keep their X (CAM-36). */
export function isEnd(cam: CamTable, index: number): boolean {
  return index === 0 || index === cam.points.length - 1;
}

/** Between which X a point may move: the open interval between its neighbours, less the least width. */
export function roomOf(cam: CamTable, index: number): readonly [number, number] {
  const point = cam.points[index]!;
  if (isEnd(cam, index)) return [point.x, point.x];
  const width = leastWidth(cam);
  const least = cam.points[index - 1]!.x + width;
  const greatest = cam.points[index + 1]!.x - width;
  return least <= greatest ? [least, greatest] : [point.x, point.x];
}

/** The segment that an X lies in; at a point the one behind it. */
export function segmentAt(cam: CamTable, x: number): number {
  let low = 0;
  let high = cam.segments.length - 1;
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (cam.points[middle]!.x <= x) low = middle;
    else high = middle - 1;
  }
  return low;
}

export function within(value: number, [least, greatest]: readonly [number, number]): number {
  return Math.min(greatest, Math.max(least, value));
}

/** The list with one of its elements replaced. */
export function replaced<Item>(list: readonly Item[], index: number, item: Item): Item[] {
  return list.map((one, at) => (at === index ? item : one));
}
