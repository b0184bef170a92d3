import { beforeEach, describe, expect, it } from 'vitest';
import type { CodeEditor } from './CodePane';
import { addPanelEditor, panelChosen, panelTable, removePanelEditor, setPanelChosen, setPanelTable } from './focus';

let enter: () => void;

beforeEach(() => {
  removePanelEditor('p', 'implementation');
  const editor = {
    onDidFocusEditorText: (listener: () => void) => {
      enter = listener;
    },
    onDidChangeCursorSelection: () => undefined,
    getPosition: () => null,
    getSelection: () => null,
    getModel: () => null,
  };
  addPanelEditor('p', 'implementation', editor as unknown as CodeEditor);
});

describe('a table beside a text editor', () => {
  it('is meant while it has the focus, with what is selected then', () => {
    let selected = ['GVL.a'];
    setPanelChosen('p', () => selected);
    selected = ['GVL.b'];
    expect(panelChosen('p')).toEqual(['GVL.b']);
  });

  it('is not meant any more when the text editor is entered', () => {
    setPanelChosen('p', () => ['GVL.a']);
    setPanelTable('p', { undo: () => undefined, redo: () => undefined });
    enter();
    expect(panelChosen('p')).toBeNull();
    expect(panelTable('p')).toBeNull();
  });
});
