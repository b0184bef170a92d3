/** Which Monaco editor of which panel had the focus last: commands and the status bar act on it. */
import { setCursor } from '@/workbench/selection';
import type { CodeEditor } from './CodePane';
import type { Part } from '../documents/documents';

interface PanelEditors {
  editors: Partial<Record<Part, CodeEditor>>;
  active: Part;
}

const panels = new Map<string, PanelEditors>();

function panelOf(panelId: string): PanelEditors {
  const known = panels.get(panelId) ?? { editors: {}, active: 'implementation' as const };
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
