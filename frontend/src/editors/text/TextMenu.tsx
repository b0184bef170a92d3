import { Eye } from 'lucide-react';
import type { ReactNode } from 'react';
import { t } from '@/i18n';
import { panelEditor } from '@/text/focus';
import type { CodeEditor } from '@/text/CodePane';
import { addEntries } from '@/online/watch/ownLists';
import { ContextMenu, type MenuEntry } from '@/ui/Menu';
import { useRegistry } from '@/workbench/commands';
import { commandContext } from '@/workbench/context';
import { entriesOf } from '@/workbench/frame/menuEntries';
import { runCommand } from '@/workbench/run';

const SYMBOL_COMMANDS = ['st.goToDefinition', 'st.peekReferences', 'st.crossReferences', null] as const;
const VALUE_COMMANDS = [
  'online.prepareValue',
  'online.writeValues',
  'online.forceValues',
  null,
  'debug.toggleBreakpoint',
  'debug.breakOnChange',
  'debug.runToCursor',
  null,
] as const;
const TEXT_COMMANDS = [
  'st.inputAssistant',
  'st.autoDeclare',
  'st.quickFix',
  'st.renameSymbol',
  'st.format',
  'st.comment',
  'bookmarks.toggle',
  null,
  'edit.cut',
  'edit.copy',
  'edit.paste',
] as const;

const FOLD_COMMANDS = ['st.fold', 'st.unfold', 'st.foldAll', 'st.unfoldAll'] as const;

/** What can be done with the symbol at the cursor; tables of text objects offer the same. */
export function symbolCommands(): readonly (string | null)[] {
  return commandContext().online === null ? SYMBOL_COMMANDS : [...SYMBOL_COMMANDS, ...VALUE_COMMANDS];
}

/** The list to which the variable at the cursor goes. */
function watchEntry(): MenuEntry {
  return {
    kind: 'sub',
    key: 'watch',
    text: t('watch.add'),
    icon: Eye,
    entries: addEntries((list) => runCommand('watch.add', { list })),
  };
}

/** Entries for the symbol at the cursor of a table, with a line behind them. */
export function symbolEntries(): MenuEntry[] {
  const commands = [...symbolCommands(), 'st.renameSymbol', 'bookmarks.toggle'];
  return [
    ...entriesOf(commands, useRegistry.getState().commands, commandContext()),
    watchEntry(),
    { kind: 'line', key: 'line-symbol' },
  ];
}

function textEntries(): MenuEntry[] {
  const { commands } = useRegistry.getState();
  const context = commandContext();
  return [
    ...entriesOf(symbolCommands(), commands, context),
    watchEntry(),
    { kind: 'line', key: 'line-watch' },
    ...entriesOf(TEXT_COMMANDS, commands, context),
    { kind: 'line', key: 'line-fold' },
    { kind: 'sub', key: 'fold', text: t('st.folding'), entries: entriesOf(FOLD_COMMANDS, commands, context) },
  ];
}

/** The context menu of a text editor: commands for the place that was clicked. */
export function TextMenu({ panelId, children }: { panelId: string; children: ReactNode }) {
  return (
    <ContextMenu
      entries={() => {
        panelEditor(panelId)?.focus();
        return textEntries();
      }}
    >
      <div style={{ height: '100%' }}>{children}</div>
    </ContextMenu>
  );
}

/** A right click outside the selection moves the cursor there, so that the menu is about what was clicked. */
export function followRightClick(editor: CodeEditor): void {
  editor.onMouseDown(({ event, target }) => {
    if (!event.rightButton || target.position === null) return;
    if (editor.getSelections()?.some((selection) => selection.containsPosition(target.position!)) === true) return;
    editor.setPosition(target.position);
  });
}
