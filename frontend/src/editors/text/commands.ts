/** Commands of text editors. What they do is offered by the focused editor; see `handlers.ts`. */
import { Braces, Eye, History, Lightbulb, ListTree, Search, WandSparkles, Waypoints } from 'lucide-react';
import { contextChanged, menuGroup, registerCommands, type Command } from '@/workbench/commands';
import { openPalette } from '@/workbench/palette/state';
import { mayChangeText } from '@/workbench/rights';
import { EDITOR_ACTIONS } from '@/text/editorActions';
import { setEditorSettings, useEditorSettings } from '@/text/settings';

/** The focused editor offers the act, and the keys act in editors alone. */
const OF_EDITOR = { scope: 'editor', delegated: true } as const;

/** Monaco finds these keys by their place on the keyboard, which differs between layouts. */
const FOLDING = [
  { id: 'fold', keys: ['Ctrl+Shift+['] },
  { id: 'unfold', keys: ['Ctrl+Shift+]'] },
  { id: 'foldAll', keys: undefined },
  { id: 'unfoldAll', keys: undefined },
] as const;

const commands: Command[] = [
  ...menuGroup(
    'edit',
    '4_insert',
    {
      id: 'st.inputAssistant',
      title: 'st.command.inputAssistant',
      icon: WandSparkles,
      keys: ['F2'],
      // Fields with a list of their own (the event of a task) take it elsewhere.
      yieldsKeys: true,
      ...OF_EDITOR,
    },
    {
      id: 'st.autoDeclare',
      title: 'st.command.autoDeclare',
      icon: Braces,
      keys: ['Shift+F2'],
      ...OF_EDITOR,
    },
    {
      id: 'st.autoDeclareWhileTyping',
      title: 'st.command.autoDeclareWhileTyping',
      checked: () => useEditorSettings.getState().autoDeclare,
      run: () => setEditorSettings({ autoDeclare: !useEditorSettings.getState().autoDeclare }),
    },
  ),
  ...menuGroup(
    'edit',
    '5_go',
    {
      id: 'st.goToDefinition',
      title: 'st.command.goToDefinition',
      icon: Search,
      keys: ['F12'],
      ...OF_EDITOR,
    },
    {
      id: 'st.peekReferences',
      title: 'st.command.references',
      keys: ['Shift+F12'],
      ...OF_EDITOR,
    },
    {
      id: 'st.crossReferences',
      title: 'st.command.crossReferences',
      icon: Waypoints,
      keys: ['Alt+Shift+F12'],
      ...OF_EDITOR,
    },
    {
      id: 'st.outline',
      title: 'st.command.outline',
      icon: ListTree,
      keys: ['Ctrl+Shift+O'],
      run: () => openPalette('members'),
    },
    {
      id: 'st.goToLine',
      title: 'st.command.goToLine',
      keys: ['Ctrl+G'],
      ...OF_EDITOR,
    },
    {
      id: 'st.nextProblem',
      title: 'st.command.nextProblem',
      keys: ['Alt+PageDown'],
      ...OF_EDITOR,
    },
    {
      id: 'st.previousProblem',
      title: 'st.command.previousProblem',
      keys: ['Alt+PageUp'],
      ...OF_EDITOR,
    },
  ),
  ...menuGroup(
    'edit',
    '6_refactor',
    {
      id: 'st.quickFix',
      title: 'st.command.quickFix',
      icon: Lightbulb,
      keys: ['Ctrl+.'],
      ...OF_EDITOR,
      enabled: mayChangeText,
    },
    {
      id: 'st.renameSymbol',
      title: 'st.command.renameSymbol',
      keys: ['Ctrl+F2'],
      ...OF_EDITOR,
      enabled: mayChangeText,
    },
    {
      id: 'st.format',
      title: 'st.command.format',
      keys: ['Shift+Alt+F'],
      ...OF_EDITOR,
      enabled: mayChangeText,
    },
    {
      id: 'st.comment',
      title: 'st.command.comment',
      keys: ['Ctrl+/'],
      ...OF_EDITOR,
      enabled: mayChangeText,
    },
  ),
  {
    id: 'st.tabMovesFocus',
    title: 'st.command.tabMovesFocus',
    keys: ['Ctrl+M'],
    menu: { menu: 'edit', group: '8_keyboard' },
    checked: () => useEditorSettings.getState().tabMovesFocus,
    run: () => setEditorSettings({ tabMovesFocus: !useEditorSettings.getState().tabMovesFocus }),
  },
  ...FOLDING.map(({ id, keys }, order): Command => ({
    id: `st.${id}`,
    title: `st.command.${id}`,
    keys,
    ...OF_EDITOR,
    menu: { menu: 'edit', group: '7_folding', order, submenu: 'st.folding' },
  })),
  ...EDITOR_ACTIONS.map(({ id, keys, changes }, order): Command => ({
    id: `text.${id}`,
    title: `text.command.${id}`,
    keys,
    // Tables have Alt and the arrows for themselves.
    scope: 'text',
    delegated: true,
    menu: { menu: 'edit', group: '7_lines', order, submenu: 'text.lines' },
    enabled: changes ? mayChangeText : undefined,
  })),
  {
    id: 'st.suggest',
    title: 'st.command.suggest',
    keys: ['Ctrl+Space'],
    ...OF_EDITOR,
    hidden: true,
  },
  {
    id: 'st.parameters',
    title: 'st.command.parameters',
    keys: ['Ctrl+Shift+Space'],
    ...OF_EDITOR,
    hidden: true,
  },
  {
    id: 'st.revisions',
    title: 'st.command.revisions',
    icon: History,
    delegated: true,
    menu: { menu: 'file', group: '4_history', order: 1 },
  },
  {
    id: 'watch.add',
    title: 'watch.addCommand',
    icon: Eye,
    // Ctrl+Shift+W would close the browser's window.
    keys: ['Shift+F9'],
    delegated: true,
    menu: { menu: 'online', group: '5_values', order: 9 },
  },
];

export function registerTextCommands(): void {
  registerCommands(commands);
  useEditorSettings.subscribe((now, before) => {
    if (now.autoDeclare !== before.autoDeclare || now.tabMovesFocus !== before.tabMovesFocus) contextChanged();
  });
}
