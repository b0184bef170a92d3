/** The camera of a path view (CNC-56, CNC-60 to CNC-62): moved in the page of the view, without the server. */
import type { ViserWindow } from '../../scene/viserWindow';
import type { Eye, Frame, Vector } from './projection';

interface Matrix {
  readonly elements: readonly number[];
}

interface Camera {
  readonly matrixWorld: Matrix;
  readonly matrixWorldInverse: Matrix;
  readonly projectionMatrix: Matrix;
  readonly fov: number;
  readonly aspect: number;
  readonly up: { x: number; y: number; z: number; set: (x: number, y: number, z: number) => unknown };
}

interface Controls {
  readonly camera: Camera;
  enabled: boolean;
  minDistance: number;
  dollyToCursor: boolean;
  readonly distance: number;
  readonly mouseButtons: { left: number; middle: number; right: number; wheel: number };
  getPosition: () => { x: number; y: number; z: number };
  getTarget: () => { x: number; y: number; z: number };
  rotate: (azimuth: number, polar: number, moving: boolean) => unknown;
  truck: (x: number, y: number, moving: boolean) => unknown;
  dolly: (distance: number, moving: boolean) => unknown;
  setLookAt: (x: number, y: number, z: number, toX: number, toY: number, toZ: number, moving: boolean) => unknown;
  updateCameraUp: () => unknown;
}

export const CAMERA_ACTS = [
  'zoomIn',
  'zoomOut',
  'tiltUp',
  'tiltDown',
  'turnLeft',
  'turnRight',
  'rollLeft',
  'rollRight',
  'up',
  'left',
  'right',
  'down',
  'alongZ',
  'alongX',
  'alongY',
] as const;
export type CameraAct = (typeof CAMERA_ACTS)[number];

/** Of camera-controls: what a button does. */
const ROTATE = 1;
const TRUCK = 2;
const DOLLY = 16;
const STEP = (15 * Math.PI) / 180;
/** How much of the picture's height a step of the camera is. */
const PART = 0.12;
const ZOOM = 0.25;
/** Space around the path that is shown as a whole. */
const MARGIN = 1.12;
const LEAST_DISTANCE = 0.02;

function controlsOf(view: ViserWindow): Controls | null {
  return (view.__viserMutable?.cameraControl ?? null) as Controls | null;
}

/** Left button moves, right button turns, the wheel zooms at the pointer. */
export function takeMouse(view: ViserWindow): void {
  const controls = controlsOf(view);
  if (controls === null) return;
  Object.assign(controls.mouseButtons, { left: TRUCK, right: ROTATE, middle: TRUCK, wheel: DOLLY });
  controls.minDistance = LEAST_DISTANCE;
  controls.dollyToCursor = true;
}

/** Where the camera is; null while the page of the view is not ready. */
export function eyeOf(view: ViserWindow): Eye | null {
  const camera = controlsOf(view)?.camera;
  if (camera === undefined || view.innerWidth === 0 || view.innerHeight === 0) return null;
  return {
    world: camera.matrixWorld.elements,
    inverse: camera.matrixWorldInverse.elements,
    projection: camera.projectionMatrix.elements,
    width: view.innerWidth,
    height: view.innerHeight,
  };
}

/** An eye that stays as it is, whatever the camera does. */
export function still(eye: Eye): Eye {
  return { ...eye, world: [...eye.world], inverse: [...eye.inverse], projection: [...eye.projection] };
}

export function sameEye(a: Eye | null, b: Eye | null): boolean {
  if (a === null || b === null) return a === b;
  return (
    a.width === b.width &&
    a.height === b.height &&
    a.inverse.every((value, at) => value === b.inverse[at]) &&
    a.projection.every((value, at) => value === b.projection[at])
  );
}

/** While something is dragged the camera stands. */
export function holdCamera(view: ViserWindow, held: boolean): void {
  const controls = controlsOf(view);
  if (controls !== null) controls.enabled = !held;
}

export interface Box {
  readonly low: Vector;
  readonly high: Vector;
}

export function runCamera(view: ViserWindow, act: CameraAct, frame: Frame, box: Box): void {
  const controls = controlsOf(view);
  if (controls === null) return;
  const part = PART * 2 * controls.distance * Math.tan((controls.camera.fov * Math.PI) / 360);
  const acts: Record<CameraAct, () => unknown> = {
    zoomIn: () => controls.dolly(controls.distance * ZOOM, true),
    zoomOut: () => controls.dolly((-controls.distance * ZOOM) / (1 - ZOOM), true),
    tiltUp: () => controls.rotate(0, STEP, true),
    tiltDown: () => controls.rotate(0, -STEP, true),
    turnLeft: () => controls.rotate(STEP, 0, true),
    turnRight: () => controls.rotate(-STEP, 0, true),
    rollLeft: () => roll(controls, -STEP),
    rollRight: () => roll(controls, STEP),
    // The camera moves, so the path goes the other way.
    up: () => controls.truck(0, -part, true),
    down: () => controls.truck(0, part, true),
    left: () => controls.truck(-part, 0, true),
    right: () => controls.truck(part, 0, true),
    alongZ: () => lookFrom(controls, [0, -1e-4, 1], frame, box),
    alongX: () => lookFrom(controls, [-1, 0, 0], frame, box),
    alongY: () => lookFrom(controls, [0, -1, 0], frame, box),
  };
  acts[act]();
}

/** Looks at the whole path from a side, Z up. */
function lookFrom(controls: Controls, side: Vector, { centre, scale }: Frame, { low, high }: Box): void {
  const { camera } = controls;
  camera.up.set(0, 1, 0);
  controls.updateCameraUp();
  const middle = [0, 1, 2].map((n) => ((low[n]! + high[n]!) / 2 - centre[n]!) * scale);
  const half = [0, 1, 2].map((n) => Math.max(((high[n]! - low[n]!) / 2) * scale, 1e-3));
  const deep = Math.abs(side[0]) === 1 ? 0 : Math.abs(side[1]) === 1 ? 1 : 2;
  const [wide, tall] = [deep === 0 ? 1 : 0, deep === 2 ? 1 : 2];
  const slope = Math.tan((camera.fov * Math.PI) / 360);
  const distance = Math.max(half[tall]!, half[wide]! / camera.aspect) * (MARGIN / slope) + half[deep]!;
  const at = (n: number) => middle[n]! + side[n]! * Math.max(distance, 10 * LEAST_DISTANCE);
  controls.setLookAt(at(0), at(2), -at(1), middle[0]!, middle[2]!, -middle[1]!, false);
}

/** Turns the picture around the direction in which the camera looks. */
function roll(controls: Controls, angle: number): void {
  const from = controls.getPosition();
  const to = controls.getTarget();
  const way = [to.x - from.x, to.y - from.y, to.z - from.z];
  const length = Math.hypot(...way);
  const [ax, ay, az] = way.map((value) => value / length) as [number, number, number];
  // What is up in the picture, not in the scene: else a camera that looks along the latter cannot be rolled.
  const m = controls.camera.matrixWorld.elements;
  const [ux, uy, uz] = [m[4]!, m[5]!, m[6]!];
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  controls.camera.up.set(
    ux * c + (ay * uz - az * uy) * s,
    uy * c + (az * ux - ax * uz) * s,
    uz * c + (ax * uy - ay * ux) * s,
  );
  controls.updateCameraUp();
  controls.setLookAt(from.x, from.y, from.z, to.x, to.y, to.z, false);
}
