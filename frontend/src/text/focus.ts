/** Which Monaco editor of which panel had the focus last: commands and the status bar act on it. */
import { setCursor } from '@/workbench/selection';
import type { CodeEditor } from './CodePane';
import type { Part } from '@/project/partUri';

/** What acts on a name need of the view that shows it. */
export type TextPlace = Pick<CodeEditor, 'getModel' | 'getPosition' | 'getSelection' | 'focus'>;

/** A view that is no text editor but shows and changes a text. */
export interface PanelTable {
  undo: () => void;
  redo: () => void;
  /** Where in the text its cursor stands. */
  place?: TextPlace;
  /** Its own acts, by command. */
  acts?: Readonly<Record<string, () => void | Promise<void>>>;
  /** Carries out jumps into the body itself. */
  jumps?: boolean;
}

interface PanelEditors {
  editors: Partial<Record<Part, CodeEditor>>;
  active: Part;
  /** Shows a place without having been entered. */
  shown: Part | null;
  table: PanelTable | null;
  chosen: (() => readonly string[]) | null;
  prepare: Partial<Record<Part, () => boolean>>;
}

const panels = new Map<string, PanelEditors>();

function panelOf(panelId: string): PanelEditors {
  const known = panels.get(panelId) ?? {
    editors: {},
    active: 'implementation' as const,
    shown: null,
    table: null,
    chosen: null,
    prepare: {},
  };
  panels.set(panelId, known);
  return known;
}

/** Adds an editor of a panel; the status bar follows its cursor while it is the one used last. */
export function addPanelEditor(panelId: string, part: Part, editor: CodeEditor): void {
  const panel = panelOf(panelId);
  panel.editors[part] = editor;
  const report = () => {
    const position = editor.getPosition();
    const selection = editor.getSelection();
    const model = editor.getModel();
    if (position === null || model === null) return;
    const selected = selection === null ? 0 : model.getValueLengthInRange(selection);
    setCursor(panelId, { line: position.lineNumber, column: position.column, selected });
  };
  editor.onDidFocusEditorText(() => {
    panel.active = part;
    panel.shown = null;
    panel.table = null;
    panel.chosen = null;
    report();
  });
  editor.onDidChangeCursorSelection(() => {
    if (editor.hasTextFocus() || panel.shown === part) report();
  });
}

/** A place is to be shown in this part while the keyboard is elsewhere: commands and the status bar go with it. */
export function showPanelPart(panelId: string, part: Part): void {
  const panel = panelOf(panelId);
  panel.active = part;
  panel.shown = part;
}

export function removePanelEditor(panelId: string, part: Part): void {
  const panel = panels.get(panelId);
  if (panel === undefined) return;
  delete panel.editors[part];
  if (Object.keys(panel.editors).length === 0 && panel.table?.place === undefined) {
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
export function setPanelTable(panelId: string, table: PanelTable | null): void {
  const panel = panelOf(panelId);
  panel.table = table;
  if (table === null && Object.keys(panel.editors).length === 0) panels.delete(panelId);
}

export function panelTable(panelId: string): PanelTable | null {
  return panels.get(panelId)?.table ?? null;
}

/** Where the user is: in the table or the text editor of the panel that had the focus last. */
export function panelPlace(panelId: string): TextPlace | null {
  return panelTable(panelId)?.place ?? panelEditor(panelId);
}

/** A table of values has the focus: its selected expressions are meant until a text editor is entered. */
export function setPanelChosen(panelId: string, chosen: (() => readonly string[]) | null): void {
  panelOf(panelId).chosen = chosen;
}

/** The expressions selected in the table that has the focus; null when none has. */
export function panelChosen(panelId: string): readonly string[] | null {
  return panels.get(panelId)?.chosen?.() ?? null;
}

/** Opens the field for a value at the cursor of an editor; false where no variable with a value stands. */
export function setPanelPrepare(panelId: string, part: Part, prepare: (() => boolean) | null): void {
  const panel = panelOf(panelId);
  if (prepare === null) delete panel.prepare[part];
  else panel.prepare[part] = prepare;
}

export function panelPrepare(panelId: string): boolean {
  const panel = panels.get(panelId);
  return panel?.prepare[panel.active]?.() ?? false;
}
