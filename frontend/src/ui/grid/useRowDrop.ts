import { useState, type DragEvent, type RefObject } from 'react';

export interface RowDrop {
  /** What dropping here would do; null: it cannot be dropped. */
  effect: (event: DragEvent) => 'move' | 'copy' | null;
  /** Dropped in front of a row, or (at the number of rows) behind the last one. */
  drop: (before: number, event: DragEvent) => void;
}

/** Rows dropped between the rows of a table: where the mark is to be shown, and what the table listens to. */
export function useRowDrop(
  drop: RowDrop | undefined,
  body: RefObject<HTMLElement | null>,
  count: number,
  height: number,
) {
  const [at, setAt] = useState<number | null>(null);
  if (drop === undefined) return { at: null, listeners: {} };
  const placeOf = (event: DragEvent) => {
    const top = body.current?.getBoundingClientRect().top ?? 0;
    return Math.max(0, Math.min(count, Math.round((event.clientY - top) / height)));
  };
  const listeners = {
    onDragOver: (event: DragEvent) => {
      const effect = drop.effect(event);
      if (effect === null) return;
      event.preventDefault();
      event.dataTransfer.dropEffect = effect;
      setAt(placeOf(event));
    },
    onDragLeave: (event: DragEvent) => {
      const to = event.relatedTarget;
      if (!(to instanceof Node && event.currentTarget.contains(to))) setAt(null);
    },
    onDragEnd: () => setAt(null),
    onDrop: (event: DragEvent) => {
      setAt(null);
      if (drop.effect(event) === null) return;
      event.preventDefault();
      drop.drop(placeOf(event), event);
    },
  };
  return { at, listeners };
}
