/** What is read of viser's own page inside the frame of a view, which comes from the same server. */

interface Vector {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

interface CameraControl {
  getPosition: () => Vector;
  getTarget: () => Vector;
  setLookAt: (x: number, y: number, z: number, toX: number, toY: number, toZ: number, moving: boolean) => unknown;
}

/** The names are those by which viser's tests reach into its page. */
export interface ViserWindow extends Window {
  __viserMutable?: { cameraControl: CameraControl | null; requestRender: () => void };
  __viserSceneTree?: { getState: () => Readonly<Record<string, unknown>> };
}

const LOOK_MS = 50;
/** The floor is the first thing that the server draws. */
const FLOOR = '/floor';
/** Looks that are waited for behind the first node: the camera comes in the same message and is put in place then. */
const SETTLING = 3;

/** Calls `drawn` once the page holds the scene and its camera stands; returns what ends the waiting. */
export function whenDrawn(view: ViserWindow, drawn: () => void): () => void {
  let settled = 0;
  const timer = setInterval(() => {
    const ready = view.__viserMutable?.cameraControl && view.__viserSceneTree?.getState()[FLOOR] !== undefined;
    if (!ready) return;
    settled += 1;
    if (settled < SETTLING) return;
    clearInterval(timer);
    showAtOnce(view);
    drawn();
  }, LOOK_MS);
  return () => clearInterval(timer);
}

/** viser fades its picture in over several pictures, of which a scene that stands still draws hardly any. */
function showAtOnce(view: ViserWindow): void {
  view.document.querySelectorAll('canvas').forEach((canvas) => (canvas.style.opacity = '1'));
  view.__viserMutable?.requestRender();
}

/** Looks at the scene from the same place as another view of it. */
export function takeCamera(view: ViserWindow, from: ViserWindow): void {
  const other = from.__viserMutable?.cameraControl;
  if (!other) return;
  const [position, target] = [other.getPosition(), other.getTarget()];
  view.__viserMutable?.cameraControl?.setLookAt(
    position.x,
    position.y,
    position.z,
    target.x,
    target.y,
    target.z,
    false,
  );
}
