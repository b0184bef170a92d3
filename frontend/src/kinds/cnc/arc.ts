/** Circular arcs in the X/Y plane (cnc.md GEO-05 to GEO-08, cnc EX-16). Angles in radians, counter-clockwise positive. */

export type Point = readonly [number, number];

export interface Arc {
  readonly centre: Point;
  readonly radius: number;
  readonly from: number;
  /** Signed: positive counter-clockwise. */
  readonly sweep: number;
}

const TURN = 2 * Math.PI;
/** Start and end may be off the circle by this part of its radius (GEO-06). */
const TOLERANCE = 0.1;

function arcAround(centre: Point, start: Point, end: Point, clockwise: boolean): Arc {
  const from = Math.atan2(start[1] - centre[1], start[0] - centre[0]);
  const to = Math.atan2(end[1] - centre[1], end[0] - centre[0]);
  let sweep = (to - from) % TURN;
  const same = start[0] === end[0] && start[1] === end[1];
  if (clockwise && (sweep >= 0 || same)) sweep = same ? -TURN : sweep - TURN;
  if (!clockwise && (sweep <= 0 || same)) sweep = same ? TURN : sweep + TURN;
  return { centre, radius: Math.hypot(start[0] - centre[0], start[1] - centre[1]), from, sweep };
}

/** The arc of at most half a circle with a radius; null where the points are too far apart, or the same. */
export function arcOfRadius(start: Point, end: Point, radius: number, clockwise: boolean): Arc | null {
  const dx = end[0] - start[0];
  const dy = end[1] - start[1];
  const chord = Math.hypot(dx, dy);
  const size = Math.abs(radius);
  // Half a circle whose chord is longer by rounding alone is one.
  if (!(chord > 0) || chord > 2 * size * (1 + 1e-9)) return null;
  const height = Math.sqrt(Math.max(0, size * size - (chord * chord) / 4));
  const side = clockwise ? 1 : -1;
  const centre: Point = [
    (start[0] + end[0]) / 2 + (side * height * dy) / chord,
    (start[1] + end[1]) / 2 - (side * height * dx) / chord,
  ];
  const arc = arcAround(centre, start, end, clockwise);
  return { ...arc, sweep: Math.sign(arc.sweep) * Math.min(Math.abs(arc.sweep), Math.PI) };
}

/** The arc around a centre; one that is little off is moved onto the bisector, null where it is far off (GEO-06). */
export function arcOfCentre(start: Point, end: Point, centre: Point, clockwise: boolean): Arc | null {
  const near = Math.hypot(start[0] - centre[0], start[1] - centre[1]);
  const far = Math.hypot(end[0] - centre[0], end[1] - centre[1]);
  if (!(near > 0) || !(Math.abs(near - far) <= TOLERANCE * Math.max(near, far))) return null;
  const dx = end[0] - start[0];
  const dy = end[1] - start[1];
  const chord = dx * dx + dy * dy;
  if (chord === 0 || near === far) return arcAround(centre, start, end, clockwise);
  const along = ((centre[0] - (start[0] + end[0]) / 2) * dx + (centre[1] - (start[1] + end[1]) / 2) * dy) / chord;
  return arcAround([centre[0] - along * dx, centre[1] - along * dy], start, end, clockwise);
}

/** The arc around a centre over an angle in degrees (GEO-07); null without a radius. */
export function arcOfAngle(start: Point, centre: Point, degrees: number, clockwise: boolean): Arc | null {
  const radius = Math.hypot(start[0] - centre[0], start[1] - centre[1]);
  if (!(radius > 0)) return null;
  const from = Math.atan2(start[1] - centre[1], start[0] - centre[0]);
  return { centre, radius, from, sweep: ((clockwise ? -1 : 1) * degrees * Math.PI) / 180 };
}

/** The point at a part of an arc, 0 at its start and 1 at its end. */
export function pointOn(arc: Arc, part: number): Point {
  const angle = arc.from + arc.sweep * part;
  return [arc.centre[0] + arc.radius * Math.cos(angle), arc.centre[1] + arc.radius * Math.sin(angle)];
}
