/** What the delegated commands do in a text editor. */
import type { Handlers } from '@/workbench/commands';
import { setDirty } from '@/workbench/selection';
import {
  addExpressionsToWatch,
  addToWatch,
  autoDeclare,
  inputAssistant,
  rename,
  revisions,
  showCrossReferences,
  type TextPanel,
} from './acts';
import type { CodeEditor } from './CodePane';
import { panelChosen, panelEditor, panelHistory } from './focus';
import { partsShown } from './parts';

/** Monaco's own command behind each of ours. */
export const ACTIONS: Readonly<Record<string, string>> = {
  'edit.find': 'actions.find',
  'edit.replace': 'editor.action.startFindReplaceAction',
  'edit.selectAll': 'editor.action.selectAll',
  'edit.cut': 'editor.action.clipboardCutAction',
  'edit.copy': 'editor.action.clipboardCopyAction',
  'edit.paste': 'editor.action.clipboardPasteAction',
  'st.goToDefinition': 'editor.action.revealDefinition',
  'st.peekReferences': 'editor.action.goToReferences',
  'st.format': 'editor.action.formatDocument',
  'st.comment': 'editor.action.commentLine',
  'st.goToLine': 'editor.action.gotoLine',
  'st.quickFix': 'editor.action.quickFix',
  'st.suggest': 'editor.action.triggerSuggest',
  'st.parameters': 'editor.action.triggerParameterHints',
  'st.nextProblem': 'editor.action.marker.next',
  'st.previousProblem': 'editor.action.marker.prev',
};

/** Acts of a panel with Monaco editors: they go to the one that had the focus last. */
export function textHandlers(panelId: string, panel: TextPanel): Handlers {
  const { document, object } = panel;
  const onEditor = (run: (editor: CodeEditor) => Promise<void> | void) => ({
    run: () => {
      const editor = panelEditor(panelId);
      if (editor !== null) return run(editor);
    },
  });
  const act = (id: string) => ({
    run: () => {
      const editor = panelEditor(panelId);
      editor?.focus();
      // Not every command of Monaco is an action of the editor; `trigger` finds all of them.
      editor?.trigger('command', id, null);
    },
  });
  const history = (command: 'undo' | 'redo') => ({
    run: () => {
      const table = panelHistory(panelId);
      if (table !== null) {
        table[command]();
        return;
      }
      const editor = panelEditor(panelId);
      if (editor?.getRawOptions().readOnly === true) return;
      editor?.focus();
      editor?.trigger('command', command, null);
    },
  });
  return {
    ...Object.fromEntries(Object.entries(ACTIONS).map(([command, action]) => [command, act(action)])),
    'edit.undo': history('undo'),
    'edit.redo': history('redo'),
    'st.inputAssistant': onEditor((editor) => inputAssistant(panel, editor)),
    'st.autoDeclare': onEditor((editor) => autoDeclare(panel, editor)),
    'st.renameSymbol': onEditor((editor) => rename(panel, editor)),
    'st.crossReferences': onEditor((editor) => showCrossReferences(panel, editor)),
    'watch.add': {
      run: () => {
        const chosen = panelChosen(panelId);
        const editor = panelEditor(panelId);
        if (chosen !== null) addExpressionsToWatch(chosen);
        else if (editor !== null) addToWatch(panel, editor);
      },
    },
    'st.revisions': { run: () => revisions(panel, partsShown(object.kind)) },
    'file.save': {
      run: async () => {
        await document.save();
        // At once, since a build that has just asked for saving looks at it next.
        setDirty(panelId, document.phase !== 'clean');
      },
    },
  };
}
