import type { PlacementRule } from '@/api/types';
import { useState, type DragEvent } from 'react';
import { commandContext } from '../context';
import { guard } from '@/ui/notices';
import { copyObject, moveObject } from './acts';
import { topMost, type Forest, type Row, type TreeView } from '@/project/tree';
import { dropPlace, mayDrop } from '@/project/placement';

const FORMAT = 'application/x-tappet-objects';

/** Objects being dragged: a drop target may not read the drag's data before the drop. */
let dragged: readonly string[] = [];

export interface DropMark {
  id: string;
  where: 'before' | 'inside' | 'after';
}

interface DragOptions {
  projectId: string;
  view: TreeView;
  forest: Forest;
  rules: readonly PlacementRule[];
  /** Ids that a drag of this row takes along. */
  taken: (id: string) => readonly string[];
  onMoved: (parentId: string | null) => void;
}

/** Drag and drop of objects: moves, with Ctrl copies; only where the placement rules allow it. */
export function useDrag({ projectId, view, forest, rules, taken, onMoved }: DragOptions) {
  const [mark, setMark] = useState<DropMark | null>(null);
  const [overRoot, setOverRoot] = useState(false);

  const start = (event: DragEvent, id: string) => {
    const { role, online } = commandContext();
    if ((role !== 'engineer' && role !== 'admin') || online) {
      event.preventDefault();
      return;
    }
    dragged = topMost(forest, taken(id));
    event.dataTransfer.setData(FORMAT, dragged.join(' '));
    event.dataTransfer.setData('text/plain', dragged.map((each) => forest.byId.get(each)?.name ?? '').join('\n'));
    event.dataTransfer.effectAllowed = 'copyMove';
  };

  const over = (event: DragEvent, row: Row) => {
    const box = event.currentTarget.getBoundingClientRect();
    const at = (event.clientY - box.top) / box.height;
    const wishes: DropMark['where'][] =
      at < 0.3 ? ['before', 'inside'] : at > 0.7 ? ['after', 'inside'] : ['inside', at < 0.5 ? 'before' : 'after'];
    const where = wishes.find((wish) => {
      const place = dropPlace(forest, row.object, wish);
      return !dragged.includes(row.object.id) && mayDrop(rules, forest, dragged, place.parentId, view, event.ctrlKey);
    });
    event.stopPropagation();
    setOverRoot(false);
    if (!where) {
      setMark(null);
      return;
    }
    event.preventDefault();
    event.dataTransfer.dropEffect = event.ctrlKey ? 'copy' : 'move';
    if (mark?.id !== row.object.id || mark.where !== where) setMark({ id: row.object.id, where });
  };

  const overBackground = (event: DragEvent) => {
    const fits = dragged.length > 0 && mayDrop(rules, forest, dragged, null, view, event.ctrlKey);
    setMark(null);
    setOverRoot(fits);
    if (!fits) return;
    event.preventDefault();
    event.dataTransfer.dropEffect = event.ctrlKey ? 'copy' : 'move';
  };

  const end = () => {
    setMark(null);
    setOverRoot(false);
    dragged = [];
  };

  const drop = (event: DragEvent) => {
    event.preventDefault();
    event.stopPropagation();
    const ids = dragged;
    const copy = event.ctrlKey;
    const target = mark && forest.byId.get(mark.id);
    const place = target ? dropPlace(forest, target, mark.where) : { parentId: null, index: forest.byId.size };
    end();
    void guard(async () => {
      let { index } = place;
      for (const id of ids) {
        const object = forest.byId.get(id);
        if (!object) continue;
        if (copy) await copyObject(projectId, id, place.parentId);
        else {
          // Taken out from above its new place, an object leaves one place less before it.
          const above = object.parent_id === place.parentId && object.index < index;
          await moveObject(projectId, object, place.parentId, above ? index - 1 : index);
          if (!above) index++;
        }
      }
      onMoved(place.parentId);
    });
  };

  return { mark, overRoot, start, over, overBackground, leave: () => setMark(null), drop, end };
}
