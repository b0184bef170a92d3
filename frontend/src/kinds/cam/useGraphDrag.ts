/** Dragging in a graph: points (CAM-36), segments with both of their points, and what is shown of the master. */
import { useRef, type PointerEvent } from 'react';
import { movePoint } from './points';
import type { CamTable } from './camTable';
import type { CamEdit } from './edit';
import { snapped, type GraphName, type Range } from './plot';

export type Editable = Exclude<GraphName, 'j'>;

export interface Place {
  x: number;
  value: number;
}

interface Drag {
  kind: 'point' | 'segment' | 'pan';
  index: number;
  from: Place;
  pixel: number;
  cam: CamTable;
  /** Of the graph when the drag began: the scale stays under the pointer. */
  values: Range;
  moved: boolean;
  last: CamTable | null;
}

interface DragOptions {
  edit: CamEdit;
  graph: GraphName;
  values: Range;
  /** The place under the pointer by the scale given. */
  placeAt: (event: PointerEvent, values: Range) => Place;
  /** Steps that X and value move in. */
  steps: { x: number; value: number };
  pan: (byPixels: number) => void;
}

/** The cam with both ends of a segment moved alike in one derivative. */
export function moveSegment(cam: CamTable, segment: number, graph: Editable, by: number): CamTable {
  const left = cam.points[segment]!;
  const right = cam.points[segment + 1]!;
  const moved = movePoint(cam, segment, { [graph]: left[graph] + by });
  return movePoint(moved, segment + 1, { [graph]: right[graph] + by });
}

export function useGraphDrag({ edit, graph, values, placeAt, steps, pan }: DragOptions) {
  const drag = useRef<Drag | null>(null);

  const begin = (event: PointerEvent, kind: Drag['kind'], index: number) => {
    event.currentTarget.setPointerCapture(event.pointerId);
    drag.current = {
      kind,
      index,
      from: placeAt(event, values),
      pixel: event.clientX,
      cam: edit.cam,
      values,
      moved: false,
      last: null,
    };
  };

  /** Moves what is dragged; returns whether something is. */
  const move = (event: PointerEvent): boolean => {
    const now = drag.current;
    if (now === null) return false;
    if (now.kind === 'pan') {
      pan(now.pixel - event.clientX);
      now.pixel = event.clientX;
      return true;
    }
    if (!now.moved && Math.abs(event.clientX - now.pixel) < 3 && event.movementY === 0) return true;
    if (edit.locked || graph === 'j') return true;
    now.moved = true;
    const at = placeAt(event, now.values);
    const fit = (value: number, step: number) => (event.altKey ? value : snapped(value, step));
    if (now.kind === 'point') {
      const point = now.cam.points[now.index]!;
      const value = fit(point[graph] + at.value - now.from.value, steps.value);
      const x = fit(point.x + at.x - now.from.x, steps.x);
      now.last = movePoint(now.cam, now.index, event.shiftKey ? { [graph]: value } : { x, [graph]: value });
    } else now.last = moveSegment(now.cam, now.index, graph, fit(at.value - now.from.value, steps.value));
    edit.preview(now.last);
    return true;
  };

  const end = (taken: boolean) => {
    const now = drag.current;
    drag.current = null;
    if (now?.last == null) return;
    if (taken) edit.change(now.last);
    else edit.preview(null);
  };

  return { begin, move, end, active: () => drag.current !== null, frozen: () => drag.current?.values ?? null };
}
