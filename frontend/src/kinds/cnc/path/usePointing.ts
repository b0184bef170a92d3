import { useEffect, useState } from 'react';
import type { ViserWindow } from '../../scene/viserWindow';
import { eyeOf } from './camera';
import type { PathView } from './pathView';
import { pixelAngle, rayThrough, type Frame } from './projection';

/** A pointer that moved further drags the camera. */
const CLICK_PX = 4;
const NEAR_PX = 7;

interface Pointed {
  readonly line: number;
  /** On the element. */
  readonly place: readonly number[];
}

/** Clicks and keys in the page of a view: a click chooses the element under it, Del deletes it (CNC-54, CNC-58). */
export function usePointing(
  window: ViserWindow | null,
  view: PathView,
  frame: Frame | null,
  onLine: (line: number) => void,
  onDelete: () => void,
): Pointed | null {
  const [pointed, setPointed] = useState<Pointed | null>(null);
  useEffect(() => {
    if (window === null || frame === null) return;
    let down: { x: number; y: number } | null = null;
    let last = 0;
    const pressed = (event: PointerEvent) => {
      down = event.button === 0 ? { x: event.clientX, y: event.clientY } : null;
    };
    const released = (event: PointerEvent) => {
      const from = down;
      down = null;
      if (from === null || Math.hypot(event.clientX - from.x, event.clientY - from.y) > CLICK_PX) return;
      const eye = eyeOf(window);
      if (eye === null) return;
      const serial = ++last;
      const ray = rayThrough(eye, frame, { x: event.clientX, y: event.clientY });
      view.pick(ray, NEAR_PX * pixelAngle(eye)).then(
        (found) => {
          if (serial !== last || found?.element == null || found.element.line < 0) return;
          setPointed({ line: found.element.line, place: found.place ?? found.element.end });
          onLine(found.element.line);
        },
        // The view is being made anew; the next click finds it.
        () => undefined,
      );
    };
    const typed = (event: KeyboardEvent) => {
      if (event.key !== 'Delete' || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      onDelete();
    };
    const { document } = window;
    document.addEventListener('pointerdown', pressed, true);
    document.addEventListener('pointerup', released, true);
    document.addEventListener('keydown', typed, true);
    return () => {
      document.removeEventListener('pointerdown', pressed, true);
      document.removeEventListener('pointerup', released, true);
      document.removeEventListener('keydown', typed, true);
    };
  }, [window, view, frame, onLine, onDelete]);
  return pointed;
}
