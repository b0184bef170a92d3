/** Which Monaco editor of which panel had the focus last: commands and the status bar act on it. */
import { setCursor } from '@/workbench/selection';
import type { CodeEditor } from './CodePane';
import type { Part } from '../documents/documents';

/** Undo and redo of a view that is no text editor but changes a text. */
export interface PanelHistory {
  undo: () => void;
  redo: () => void;
}

interface PanelEditors {
  editors: Partial<Record<Part, CodeEditor>>;
  active: Part;
  history: PanelHistory | null;
  chosen: (() => readonly string[]) | null;
}

const panels = new Map<string, PanelEditors>();

function panelOf(panelId: string): PanelEditors {
  const known = panels.get(panelId) ?? { editors: {}, active: 'implementation' as const, history: null, chosen: null };
  panels.set(panelId, known);
  return known;
}

/** Adds an editor of a panel; the status bar follows its cursor while it has the focus. */
export function addPanelEditor(panelId: string, part: Part, editor: CodeEditor): void {
  const panel = panelOf(panelId);
  panel.editors[part] = editor;
  const tell = () => {
    const position = editor.getPosition();
    const selection = editor.getSelection();
    const model = editor.getModel();
    if (position === null || model === null) return;
    const selected = selection === null ? 0 : model.getValueLengthInRange(selection);
    setCursor(panelId, { line: position.lineNumber, column: position.column, selected });
  };
  editor.onDidFocusEditorText(() => {
    panel.active = part;
    panel.history = null;
    panel.chosen = null;
    tell();
  });
  editor.onDidChangeCursorSelection(() => {
    if (editor.hasTextFocus()) tell();
  });
}

export function removePanelEditor(panelId: string, part: Part): void {
  const panel = panels.get(panelId);
  if (panel === undefined) return;
  delete panel.editors[part];
  if (Object.keys(panel.editors).length === 0) {
    panels.delete(panelId);
    setCursor(panelId, null);
  }
}

/** The editor of the panel that had the focus last, or the only one it has. */
export function panelEditor(panelId: string | null | undefined): CodeEditor | null {
  const panel = panelId == null ? undefined : panels.get(panelId);
  if (panel === undefined) return null;
  return panel.editors[panel.active] ?? Object.values(panel.editors)[0] ?? null;
}

export function panelEditorOf(panelId: string, part: Part): CodeEditor | null {
  return panels.get(panelId)?.editors[part] ?? null;
}

/** A table has the focus: undo and redo are its affair until a text editor is entered; null when it goes away. */
export function setPanelHistory(panelId: string, history: PanelHistory | null): void {
  panelOf(panelId).history = history;
}

export function panelHistory(panelId: string): PanelHistory | null {
  return panels.get(panelId)?.history ?? null;
}

/** A table of values has the focus: its selected expressions are meant until a text editor is entered. */
export function setPanelChosen(panelId: string, chosen: (() => readonly string[]) | null): void {
  panelOf(panelId).chosen = chosen;
}

/** The expressions selected in the table that has the focus; null when none has. */
export function panelChosen(panelId: string): readonly string[] | null {
  return panels.get(panelId)?.chosen?.() ?? null;
}
