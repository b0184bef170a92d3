/**
 * Where a place of the path is on the screen, and which ray goes through a point of the screen.
 *
 * Two frames: the path's own (program units), and that of the picture, in which the server draws (`Frame`) and the
 * camera is (`Eye`).
 */

export type Vector = readonly [number, number, number];

/** A place of the picture is (place - centre) * scale. */
export interface Frame {
  readonly centre: Vector;
  readonly scale: number;
}

/** A camera in the frame of the picture: matrices by columns, as three.js has them. */
export interface Eye {
  readonly world: readonly number[];
  readonly inverse: readonly number[];
  readonly projection: readonly number[];
  readonly width: number;
  readonly height: number;
}

export interface Seen {
  readonly x: number;
  readonly y: number;
}

export interface Ray {
  readonly origin: Vector;
  readonly ahead: Vector;
}

export function plus(a: Vector, b: Vector, factor = 1): Vector {
  return [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];
}

export function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function size(a: Vector): number {
  return Math.hypot(...a);
}

function drawnAt({ centre, scale }: Frame, place: Vector): Vector {
  const [x, y, z] = plus(place, centre, -1);
  return [x * scale, y * scale, z * scale];
}

/** Rows of a matrix that is stored by columns, times a place. */
function times(matrix: readonly number[], [x, y, z]: Vector, w: number): [number, number, number, number] {
  const row = (n: number) => matrix[n]! * x + matrix[n + 4]! * y + matrix[n + 8]! * z + matrix[n + 12]! * w;
  return [row(0), row(1), row(2), row(3)];
}

/** The place in pixels from the upper left corner; null for one behind the camera. */
export function seenAt(eye: Eye, frame: Frame, place: Vector): Seen | null {
  const [x, y, z] = times(eye.inverse, drawnAt(frame, place), 1);
  if (z >= 0) return null;
  const [u, v, , w] = times(eye.projection, [x, y, z], 1);
  return { x: ((u / w + 1) / 2) * eye.width, y: ((1 - v / w) / 2) * eye.height };
}

/** The ray through a point of the screen, in path units with a direction of length 1. */
export function rayThrough(eye: Eye, frame: Frame, { x, y }: Seen): Ray {
  const across = ((x / eye.width) * 2 - 1) / eye.projection[0]!;
  const up = (1 - (y / eye.height) * 2) / eye.projection[5]!;
  const [ax, ay, az] = times(eye.world, [across, up, -1], 0);
  const length = Math.hypot(ax, ay, az);
  const [ox, oy, oz] = times(eye.world, [0, 0, 0], 1);
  const { centre, scale } = frame;
  return {
    origin: plus(centre, [ox, oy, oz], 1 / scale),
    ahead: [ax / length, ay / length, az / length],
  };
}

/** Angle of a pixel [rad]. */
export function pixelAngle({ projection, height }: Eye): number {
  return 2 / (projection[5]! * height);
}

/** How long a pixel is at a place [path units]. */
export function pixelSize(eye: Eye, frame: Frame, place: Vector): number {
  const [, , z] = times(eye.inverse, drawnAt(frame, place), 1);
  return (Math.abs(z) * pixelAngle(eye)) / frame.scale;
}

/** Of the planes through a place that are parallel to two axes the one that the camera sees most of; its normal. */
export function facingPlane({ ahead }: Ray): Vector {
  const sizes = ahead.map(Math.abs);
  // From above, at whatever slant, one means the plane X/Y.
  if (sizes[2]! > 0.2) return [0, 0, 1];
  return sizes[0]! > sizes[1]! ? [1, 0, 0] : [0, 1, 0];
}

/** Where a ray meets a plane; null where it does not, or behind the camera. */
export function onPlane({ origin, ahead }: Ray, place: Vector, normal: Vector): Vector | null {
  const slope = dot(ahead, normal);
  if (Math.abs(slope) < 1e-9) return null;
  const way = dot(plus(place, origin, -1), normal) / slope;
  return way > 0 ? plus(origin, ahead, way) : null;
}
