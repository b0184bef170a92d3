import { useCallback, useMemo, useState } from 'react';
import { selectionAfter, type GridCursor } from './cursor';

interface GridSelectionState {
  cursor: GridCursor | null;
  anchor: number | null;
  selected: ReadonlySet<number>;
}

const NOTHING: GridSelectionState = { cursor: null, anchor: null, selected: new Set() };

export interface GridSelection {
  cursor: GridCursor | null;
  selected: ReadonlySet<number>;
  move: (cursor: GridCursor, how: 'one' | 'toggle' | 'range') => void;
  clear: () => void;
}

/** Cursor and chosen rows of a grid; rows that no longer exist drop out. */
export function useGridSelection(count: number): GridSelection {
  const [state, setState] = useState(NOTHING);
  const move = useCallback((cursor: GridCursor, how: 'one' | 'toggle' | 'range') => {
    setState((before) => ({
      cursor,
      anchor: how === 'range' ? (before.anchor ?? cursor.row) : cursor.row,
      selected: selectionAfter(before.selected, before.anchor, cursor.row, how),
    }));
  }, []);
  const clear = useCallback(() => setState(NOTHING), []);
  return useMemo(() => {
    const inside = state.cursor !== null && state.cursor.row < count;
    return {
      cursor: inside ? state.cursor : null,
      selected: new Set([...state.selected].filter((row) => row < count)),
      move,
      clear,
    };
  }, [state, count, move, clear]);
}
