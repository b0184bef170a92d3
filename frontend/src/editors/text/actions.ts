import { EDITOR_ACTIONS } from '@/text/editorActions';
import { panelEditor } from '@/text/focus';
import type { Handler, Handlers } from '@/workbench/commands';

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
  'st.fold': 'editor.fold',
  'st.unfold': 'editor.unfold',
  'st.foldAll': 'editor.foldAll',
  'st.unfoldAll': 'editor.unfoldAll',
  'st.comment': 'editor.action.commentLine',
  'st.goToLine': 'editor.action.gotoLine',
  'st.quickFix': 'editor.action.quickFix',
  'st.suggest': 'editor.action.triggerSuggest',
  'st.parameters': 'editor.action.triggerParameterHints',
  'st.nextProblem': 'editor.action.marker.next',
  'st.previousProblem': 'editor.action.marker.prev',
  ...Object.fromEntries(EDITOR_ACTIONS.map(({ id, action }) => [`text.${id}`, action])),
};

/** Those of them that change the text. */
export const CHANGING: readonly string[] = [
  'st.format',
  'st.comment',
  'st.quickFix',
  ...EDITOR_ACTIONS.filter(({ changes }) => changes).map(({ id }) => `text.${id}`),
];

/** What is of use in a text of any language. */
const OF_ANY_TEXT = /^(edit|text)\.|^st\.(fold|unfold|foldAll|unfoldAll|comment|goToLine)$/;

/** Carries out a command of Monaco in the text of a panel that has the focus, or had it last. */
export function inEditor(panelId: string, action: string): Handler {
  return {
    run: () => {
      const editor = panelEditor(panelId);
      editor?.focus();
      // Not every command of Monaco is an action of the editor; `trigger` finds all of them.
      editor?.trigger('command', action, null);
    },
  };
}

/** Find, replace, fold, lines and the like, for a panel with a text that is no program. */
export function plainTextHandlers(panelId: string): Handlers {
  const known = Object.entries(ACTIONS).filter(([command]) => OF_ANY_TEXT.test(command));
  return Object.fromEntries(known.map(([command, action]) => [command, inEditor(panelId, action)]));
}
