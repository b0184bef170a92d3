/** Small stores of the frame: what is selected, which editor is active, what is unsaved, where the cursor is. */
import { create } from 'zustand';

export interface CursorPosition {
  line: number;
  column: number;
  /** Number of selected characters, 0 without a selection. */
  selected?: number;
}

export interface OpenEditor {
  panelId: string;
  objectId: string;
  instance: string | null;
}

interface SelectionState {
  /** Ids of the objects selected in the tree used last. */
  objectIds: readonly string[];
  /** Editors in the order in which they were opened. */
  editors: readonly OpenEditor[];
  activeEditor: string | null;
  /** Dock panel with the keyboard focus. */
  focusedPanel: string | null;
  dirty: ReadonlySet<string>;
  cursors: ReadonlyMap<string, CursorPosition>;
}

export const useSelection = create<SelectionState>(() => ({
  objectIds: [],
  editors: [],
  activeEditor: null,
  focusedPanel: null,
  dirty: new Set(),
  cursors: new Map(),
}));

export function selectObjects(objectIds: readonly string[]): void {
  useSelection.setState({ objectIds });
}

/** An editor reports whether it holds changes that are not saved. */
export function setDirty(panelId: string, dirty: boolean): void {
  const before = useSelection.getState().dirty;
  if (before.has(panelId) === dirty) return;
  const next = new Set(before);
  if (dirty) next.add(panelId);
  else next.delete(panelId);
  useSelection.setState({ dirty: next });
}

/** An editor reports the cursor position for the status bar; null when it has none. */
export function setCursor(panelId: string, position: CursorPosition | null): void {
  const cursors = new Map(useSelection.getState().cursors);
  if (position) cursors.set(panelId, position);
  else cursors.delete(panelId);
  useSelection.setState({ cursors });
}
