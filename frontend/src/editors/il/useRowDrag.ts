import type { editor } from 'monaco-editor/editor/editor.api';
import type { DragEvent } from 'react';
import type { RowDrop } from '@/ui/grid/useRowDrop';
import { copyRows } from './edits';
import type { useIlActs } from './useIlActs';

/** Distinguishes rows of IL from other things that are dragged. */
const ROWS_TYPE = 'application/x-tappet-il-rows';

/** What is being dragged in this window; the browser gives it only when it is dropped. */
let dragged: { readonly model: editor.ITextModel; readonly rows: readonly number[] } | null = null;

/** Rows dragged to another place of the table: moved, with Ctrl copied; into another table always copied. */
export function useRowDrag(
  model: editor.ITextModel,
  acts: Pick<ReturnType<typeof useIlActs>, 'move' | 'paste'>,
  selected: readonly number[],
): { begin: (row: number, event: DragEvent) => void; target: RowDrop } {
  const copies = (event: DragEvent) => event.ctrlKey || event.metaKey || dragged?.model !== model;
  return {
    begin: (row, event) => {
      dragged = { model, rows: selected.includes(row) ? selected : [row] };
      event.dataTransfer.setData(ROWS_TYPE, '');
      event.dataTransfer.setData('text/plain', copyRows(model.getValue(), dragged.rows));
      event.dataTransfer.effectAllowed = 'copyMove';
    },
    target: {
      effect: (event) => {
        if (!event.dataTransfer.types.includes(ROWS_TYPE)) return null;
        return copies(event) ? 'copy' : 'move';
      },
      drop: (before, event) => {
        if (dragged?.model === model) acts.move(dragged.rows, before, copies(event));
        else acts.paste(event.dataTransfer.getData('text/plain'), before);
        dragged = null;
      },
    },
  };
}
