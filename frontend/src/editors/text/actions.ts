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
