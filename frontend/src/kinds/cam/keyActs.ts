/** Acts of the keyboard and of the tools on what is selected in the graphs. */
import { isEnd } from './camTable';
import type { CamEdit } from './edit';
import { deletePoint, insertPoint, middleOf, movePoint, placeFor } from './points';
import type { GraphName } from './plot';
import { camRows, rowOf } from './rows';
import { moveSegment } from './useGraphDrag';

/** Steps to the right and upwards. */
export interface Nudge {
  x: -1 | 0 | 1;
  value: -1 | 0 | 1;
}

/** Selects the point or segment before or behind the selected one. */
export function stepped(edit: CamEdit, by: 1 | -1): void {
  const rows = camRows(edit.cam);
  const now = edit.selected;
  const at = now === null || now.kind === 'tappet' ? (by === 1 ? -1 : rows.length) : rowOf(now);
  const next = rows[Math.max(0, Math.min(rows.length - 1, at + by))];
  if (next) edit.select(next);
}

/** Moves the selected point by steps, or the selected segment up and down. */
export function nudged(
  edit: CamEdit,
  graph: GraphName,
  by: Nudge,
  steps: { x: number; value: number },
  factor: number,
) {
  const { cam, selected } = edit;
  if (graph === 'j') return;
  if (selected?.kind === 'point') {
    const point = cam.points[selected.index]!;
    edit.change(
      movePoint(
        cam,
        selected.index,
        by.x !== 0
          ? { x: point.x + by.x * steps.x * factor }
          : { [graph]: point[graph] + by.value * steps.value * factor },
      ),
    );
  } else if (selected?.kind === 'segment' && by.value !== 0)
    edit.change(moveSegment(cam, selected.index, graph, by.value * steps.value * factor));
}

/** Deletes the selected point; start and end stay (CAM-37). */
export function removed(edit: CamEdit): void {
  const { cam, selected } = edit;
  if (selected?.kind !== 'point' || isEnd(cam, selected.index)) return;
  edit.change(deletePoint(cam, selected.index), { kind: 'segment', index: selected.index - 1 });
}

/** Whether there is a point to delete. */
export function removable(edit: CamEdit): boolean {
  return edit.selected?.kind === 'point' && !isEnd(edit.cam, edit.selected.index);
}

/**
 * Inserts a point (CAM-35): at `x`, or in the middle of the selected segment; `value` replaces that of the curve in this graph.
 * All others are those of the curve there.
 */
export async function insertAt(edit: CamEdit, x: number | null, graph: GraphName, value: number | null): Promise<void> {
  const { cam, selected } = edit;
  const segment =
    selected?.kind === 'segment' ? selected.index : Math.min(cam.segments.length - 1, selected?.index ?? 0);
  const at = placeFor(cam, x ?? middleOf(cam, segment));
  if (at === null) return;
  const values = await edit.valuesAt(at);
  const added = insertPoint(cam, at, value === null || graph === 'j' ? values : { ...values, [graph]: value });
  edit.change(added.cam, { kind: 'point', index: added.index });
}
