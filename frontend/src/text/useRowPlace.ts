import { useEffect, useMemo, useRef } from 'react';
import type { DeclarationModel } from '@/iec/declaration/model';
import type { TextDocument } from './documents';
import type { TextPlace } from './focus';
import type { Monaco } from './monacoLoader';

interface RowPlaceInput {
  monaco: Monaco;
  document: TextDocument;
  model: DeclarationModel;
  /** Row of the declaration with the cursor, undefined where there is none, and the column of the cursor. */
  cursor: () => { row: number | undefined; column: string | undefined };
  /** Gives the table the keyboard. */
  focus: () => void;
}

/** The cursor of a table of a declaration as a place of the text: the name of its variable, in the type column its type. */
export function useRowPlace(input: RowPlaceInput): TextPlace {
  const now = useRef(input);
  useEffect(() => {
    now.current = input;
  });
  const { monaco } = input;
  return useMemo(() => {
    const text = () => now.current.document.models.declaration;
    const getPosition = () => {
      const { model } = now.current;
      const { row, column } = now.current.cursor();
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
      focus: () => now.current.focus(),
    };
  }, [monaco]);
}
