import { useEffect, useMemo, useRef, type RefObject } from 'react';
import type { DeclarationModel } from '@/iec/declaration/model';
import type { TextDocument } from '@/text/documents';
import type { TextPlace } from '@/text/focus';
import type { Monaco } from '@/text/monacoLoader';
import type { GridHandle } from '@/ui/grid/Grid';

interface RowPlaceInput {
  monaco: Monaco;
  document: TextDocument;
  model: DeclarationModel;
  /** Row of the declaration with the cursor; undefined where there is none. */
  row: number | undefined;
  /** The column of the cursor. */
  column: string | undefined;
  grid: RefObject<GridHandle | null>;
}

/** The cursor of the table as a place of the text: the name of its variable, in the type column its type. */
export function useRowPlace(input: RowPlaceInput): TextPlace {
  const now = useRef(input);
  useEffect(() => {
    now.current = input;
  });
  const { monaco } = input;
  return useMemo(() => {
    const text = () => now.current.document.models.declaration;
    const getPosition = () => {
      const { model, row, column } = now.current;
      const shown = model.rows[row ?? -1];
      const cell = column === 'type' ? shown?.type : shown?.name;
      return cell == null ? null : text().getPositionAt(cell.start);
    };
    return {
      getModel: text,
      getPosition,
      getSelection: () => {
        const at = getPosition();
        return at && new monaco.Selection(at.lineNumber, at.column, at.lineNumber, at.column);
      },
      focus: () => now.current.grid.current?.focus(),
    };
  }, [monaco]);
}
