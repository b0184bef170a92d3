/** Acts of the code editor itself that are commands here, so that menus know their keys and users can change them. */
import type { editor } from 'monaco-editor/editor/editor.api';

export const EDITOR_ACTIONS = [
  { id: 'copyLineDown', action: 'editor.action.copyLinesDownAction', keys: ['Shift+Alt+ArrowDown'], changes: true },
  { id: 'copyLineUp', action: 'editor.action.copyLinesUpAction', keys: ['Shift+Alt+ArrowUp'], changes: true },
  { id: 'moveLineDown', action: 'editor.action.moveLinesDownAction', keys: ['Alt+ArrowDown'], changes: true },
  { id: 'moveLineUp', action: 'editor.action.moveLinesUpAction', keys: ['Alt+ArrowUp'], changes: true },
  { id: 'deleteLine', action: 'editor.action.deleteLines', keys: ['Ctrl+Shift+K'], changes: true },
  { id: 'joinLines', action: 'editor.action.joinLines', keys: undefined, changes: true },
  { id: 'upperCase', action: 'editor.action.transformToUppercase', keys: undefined, changes: true },
  { id: 'lowerCase', action: 'editor.action.transformToLowercase', keys: undefined, changes: true },
  { id: 'cursorBelow', action: 'editor.action.insertCursorBelow', keys: ['Ctrl+Alt+ArrowDown'], changes: false },
  { id: 'cursorAbove', action: 'editor.action.insertCursorAbove', keys: ['Ctrl+Alt+ArrowUp'], changes: false },
  { id: 'selectNext', action: 'editor.action.addSelectionToNextFindMatch', keys: ['Ctrl+D'], changes: false },
  { id: 'selectAllSame', action: 'editor.action.selectHighlights', keys: ['Ctrl+Shift+L'], changes: false },
  { id: 'selectMore', action: 'editor.action.smartSelect.expand', keys: ['Shift+Alt+ArrowRight'], changes: false },
  { id: 'selectLess', action: 'editor.action.smartSelect.shrink', keys: ['Shift+Alt+ArrowLeft'], changes: false },
] as const;

/** What other commands of ours do in the place of the editor's own keys. */
const REPLACED = [
  'editor.action.revealDefinition',
  'editor.action.goToReferences',
  'editor.action.quickFix',
  'editor.action.rename',
  'editor.action.formatDocument',
  'editor.action.commentLine',
  'editor.action.quickCommand',
  'editor.action.gotoLine',
];

/** The part of Monaco whose keys are released. */
interface KeyTarget {
  editor: { addKeybindingRules: (rules: editor.IKeybindingRule[]) => unknown };
}

/** Takes these keys from the editor: those of the commands count, whatever the user has made of them. */
export function releaseKeys(monaco: KeyTarget): void {
  const released = [...EDITOR_ACTIONS.map(({ action }) => action), ...REPLACED];
  monaco.editor.addKeybindingRules(released.map((action) => ({ keybinding: 0, command: `-${action}` })));
}
