/** Commands of text editors. What they do is offered by the focused editor; see `handlers.ts`. */
import { Braces, Eye, History, Lightbulb, ListTree, Search, WandSparkles, Waypoints } from 'lucide-react';
import { contextChanged, registerCommands, type Command } from '@/workbench/commands';
import { openPalette } from '@/workbench/palette/state';
import { mayEdit } from '@/workbench/rights';
import { setEditorSettings, useEditorSettings } from '@/text/settings';

const commands: Command[] = [
  {
    id: 'st.inputAssistant',
    title: 'st.command.inputAssistant',
    icon: WandSparkles,
    keys: ['F2'],
    scope: 'editor',
    delegated: true,
    menu: { menu: 'edit', group: '4_insert', order: 1 },
  },
  {
    id: 'st.autoDeclare',
    title: 'st.command.autoDeclare',
    icon: Braces,
    keys: ['Shift+F2'],
    scope: 'editor',
    delegated: true,
    menu: { menu: 'edit', group: '4_insert', order: 2 },
  },
  {
    id: 'st.autoDeclareWhileTyping',
    title: 'st.command.autoDeclareWhileTyping',
    menu: { menu: 'edit', group: '4_insert', order: 3 },
    checked: () => useEditorSettings.getState().autoDeclare,
    run: () => setEditorSettings({ autoDeclare: !useEditorSettings.getState().autoDeclare }),
  },
  {
    id: 'st.goToDefinition',
    title: 'st.command.goToDefinition',
    icon: Search,
    keys: ['F12'],
    scope: 'editor',
    delegated: true,
    menu: { menu: 'edit', group: '5_go', order: 1 },
  },
  {
    id: 'st.peekReferences',
    title: 'st.command.references',
    keys: ['Shift+F12'],
    scope: 'editor',
    delegated: true,
    menu: { menu: 'edit', group: '5_go', order: 2 },
  },
  {
    id: 'st.crossReferences',
    title: 'st.command.crossReferences',
    icon: Waypoints,
    keys: ['Alt+Shift+F12'],
    scope: 'editor',
    delegated: true,
    menu: { menu: 'edit', group: '5_go', order: 2.5 },
  },
  {
    id: 'st.outline',
    title: 'st.command.outline',
    icon: ListTree,
    keys: ['Ctrl+Shift+O'],
    menu: { menu: 'edit', group: '5_go', order: 3 },
    run: () => openPalette('members'),
  },
  {
    id: 'st.goToLine',
    title: 'st.command.goToLine',
    keys: ['Ctrl+G'],
    scope: 'editor',
    delegated: true,
    menu: { menu: 'edit', group: '5_go', order: 4 },
  },
  {
    id: 'st.nextProblem',
    title: 'st.command.nextProblem',
    keys: ['Alt+PageDown'],
    scope: 'editor',
    delegated: true,
    menu: { menu: 'edit', group: '5_go', order: 5 },
  },
  {
    id: 'st.previousProblem',
    title: 'st.command.previousProblem',
    keys: ['Alt+PageUp'],
    scope: 'editor',
    delegated: true,
    menu: { menu: 'edit', group: '5_go', order: 6 },
  },
  {
    id: 'st.renameSymbol',
    title: 'st.command.renameSymbol',
    keys: ['Ctrl+F2'],
    scope: 'editor',
    delegated: true,
    enabled: mayEdit,
    menu: { menu: 'edit', group: '6_refactor', order: 1 },
  },
  {
    id: 'st.quickFix',
    title: 'st.command.quickFix',
    icon: Lightbulb,
    keys: ['Ctrl+.'],
    scope: 'editor',
    delegated: true,
    enabled: mayEdit,
    menu: { menu: 'edit', group: '6_refactor', order: 0 },
  },
  {
    id: 'st.format',
    title: 'st.command.format',
    keys: ['Shift+Alt+F'],
    scope: 'editor',
    delegated: true,
    enabled: mayEdit,
    menu: { menu: 'edit', group: '6_refactor', order: 2 },
  },
  {
    id: 'st.comment',
    title: 'st.command.comment',
    keys: ['Ctrl+/'],
    scope: 'editor',
    delegated: true,
    enabled: mayEdit,
    menu: { menu: 'edit', group: '6_refactor', order: 3 },
  },
  {
    id: 'st.suggest',
    title: 'st.command.suggest',
    keys: ['Ctrl+Space'],
    scope: 'editor',
    delegated: true,
    hidden: true,
  },
  {
    id: 'st.parameters',
    title: 'st.command.parameters',
    keys: ['Ctrl+Shift+Space'],
    scope: 'editor',
    delegated: true,
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
    if (now.autoDeclare !== before.autoDeclare) contextChanged();
  });
}
