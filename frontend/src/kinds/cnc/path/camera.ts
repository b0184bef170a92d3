/** The camera of a path view (CNC-56, CNC-60 to CNC-62): moved in the page of the view, without the server. */
import type { ViserWindow } from '../../scene/viserWindow';
import { dot, plus, type Eye, type Frame, type Vector } from './projection';

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

/** viser's own panel and notices: the workbench around the page has what is needed. */
const NOT_SHOWN = '[data-floating-window], .mantine-Notifications-root { display: none !important; }';

/** Leaves of the page of a view the picture alone. */
export function takePage(view: ViserWindow): void {
  const style = view.document.createElement('style');
  style.textContent = NOT_SHOWN;
  view.document.head.append(style);
  takeMouse(view);
}

/** Left button moves, right button turns, the wheel zooms at the pointer. */
function takeMouse(view: ViserWindow): void {
  const controls = controlsOf(view);
  if (controls === null) return;
  Object.assign(controls.mouseButtons, { left: TRUCK, right: ROTATE, middle: TRUCK, wheel: DOLLY });
  controls.minDistance = LEAST_DISTANCE;
  controls.dollyToCursor = true;
}

/** How the frame of the picture lies in that of three.js: columns of a turn. */
type Turn = readonly [Vector, Vector, Vector];

function turnOf(view: ViserWindow): Turn {
  const root = view.__viserSceneTree?.getState()[''] as { wxyz?: readonly number[] } | undefined;
  const [w, x, y, z] = (root?.wxyz ?? [1, 0, 0, 0]) as [number, number, number, number];
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
    [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
    [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
  ];
}

function turned([a, b, c]: Turn, [x, y, z]: Vector): Vector {
  return [a[0] * x + b[0] * y + c[0] * z, a[1] * x + b[1] * y + c[1] * z, a[2] * x + b[2] * y + c[2] * z];
}

/** Where the camera is; null while the page of the view is not ready. */
export function eyeOf(view: ViserWindow): Eye | null {
  const camera = controlsOf(view)?.camera;
  if (camera === undefined || view.innerWidth === 0 || view.innerHeight === 0) return null;
  const turn = turnOf(view);
  const [world, inverse] = [camera.matrixWorld.elements, camera.matrixWorldInverse.elements];
  const column = (matrix: readonly number[], n: number) => matrix.slice(4 * n, 4 * n + 3) as unknown as Vector;
  return {
    // Into the frame of the picture, and out of it: its turn is undone by the products with its columns.
    world: [0, 1, 2, 3].flatMap((n) => [...turn.map((axis) => dot(axis, column(world, n))), n === 3 ? 1 : 0]),
    inverse: [
      ...turn.flatMap(([x, y, z]) => [
        ...[0, 1, 2].map((row) => inverse[row]! * x + inverse[row + 4]! * y + inverse[row + 8]! * z),
        0,
      ]),
      ...inverse.slice(12, 16),
    ],
    projection: [...camera.projectionMatrix.elements],
    width: view.innerWidth,
    height: view.innerHeight,
  };
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
    tiltUp: () => controls.rotate(0, -STEP, true),
    tiltDown: () => controls.rotate(0, STEP, true),
    turnLeft: () => controls.rotate(STEP, 0, true),
    turnRight: () => controls.rotate(-STEP, 0, true),
    rollLeft: () => roll(controls, -STEP),
    rollRight: () => roll(controls, STEP),
    // The camera moves, so the path goes the other way.
    up: () => controls.truck(0, -part, true),
    down: () => controls.truck(0, part, true),
    left: () => controls.truck(-part, 0, true),
    right: () => controls.truck(part, 0, true),
    alongZ: () => lookFrom(controls, turnOf(view), [0, -1e-4, 1], frame, box),
    alongX: () => lookFrom(controls, turnOf(view), [-1, 0, 0], frame, box),
    alongY: () => lookFrom(controls, turnOf(view), [0, -1, 0], frame, box),
  };
  acts[act]();
}

/** Looks at the whole path from a side, Z up. */
function lookFrom(controls: Controls, turn: Turn, side: Vector, { centre, scale }: Frame, { low, high }: Box): void {
  const { camera } = controls;
  camera.up.set(...turn[2]);
  controls.updateCameraUp();
  const middle = [0, 1, 2].map((n) => ((low[n]! + high[n]!) / 2 - centre[n]!) * scale);
  const half = [0, 1, 2].map((n) => Math.max(((high[n]! - low[n]!) / 2) * scale, 1e-3));
  const deep = Math.abs(side[0]) === 1 ? 0 : Math.abs(side[1]) === 1 ? 1 : 2;
  const [wide, tall] = [deep === 0 ? 1 : 0, deep === 2 ? 1 : 2];
  const slope = Math.tan((camera.fov * Math.PI) / 360);
  const distance = Math.max(half[tall]!, half[wide]! / camera.aspect) * (MARGIN / slope) + half[deep]!;
  const to = middle as unknown as Vector;
  const from = plus(to, side, Math.max(distance, 10 * LEAST_DISTANCE));
  controls.setLookAt(...turned(turn, from), ...turned(turn, to), false);
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
