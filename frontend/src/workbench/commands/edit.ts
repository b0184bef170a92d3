import {
  ClipboardPaste,
  Copy,
  Redo2,
  Replace,
  Save,
  SaveAll,
  Scissors,
  Search,
  TextCursorInput,
  Trash2,
  Undo2,
} from 'lucide-react';
import { registerCommands, useRegistry, type Command, type Enablement } from '../commands';
import type { CommandContext } from '../context';
import { saveEditors } from '../docking/close';
import { mayEdit } from '../rights';
import { useTree } from '../tree/state';

const somethingSelected = (context: CommandContext): Enablement =>
  context.selection.length > 0 ? true : 'reason.nothingSelected';

/** Cut, delete and rename change the project when a tree has the focus; in an editor they are the editor's affair. */
const editsSelection = (context: CommandContext): Enablement => {
  if (!inTree(context)) return true;
  const allowed = mayEdit(context);
  return allowed === true ? somethingSelected(context) : allowed;
};

function inTree(context: CommandContext): boolean {
  return context.focusedPanel === 'devices' || context.focusedPanel === 'pous';
}

/** Undo in a tree would change the text of an editor that the user is not looking at. */
const inEditors = (context: CommandContext): Enablement => (inTree(context) ? 'reason.treeHistory' : true);

const commands: Command[] = [
  {
    id: 'edit.undo',
    title: 'command.undo',
    icon: Undo2,
    keys: ['Ctrl+Z'],
    delegated: true,
    enabled: inEditors,
    menu: { menu: 'edit', group: '1_undo', order: 1 },
  },
  {
    id: 'edit.redo',
    title: 'command.redo',
    icon: Redo2,
    keys: ['Ctrl+Y', 'Ctrl+Shift+Z'],
    delegated: true,
    enabled: inEditors,
    menu: { menu: 'edit', group: '1_undo', order: 2 },
  },
  {
    id: 'edit.cut',
    title: 'command.cut',
    icon: Scissors,
    keys: ['Ctrl+X'],
    scope: 'tree',
    delegated: true,
    enabled: editsSelection,
    menu: { menu: 'edit', group: '2_clipboard', order: 1 },
  },
  {
    id: 'edit.copy',
    title: 'command.copy',
    icon: Copy,
    keys: ['Ctrl+C'],
    scope: 'tree',
    delegated: true,
    enabled: (context) => (inTree(context) ? somethingSelected(context) : true),
    menu: { menu: 'edit', group: '2_clipboard', order: 2 },
  },
  {
    id: 'edit.paste',
    title: 'command.paste',
    icon: ClipboardPaste,
    keys: ['Ctrl+V'],
    scope: 'tree',
    delegated: true,
    enabled: (context) => (inTree(context) ? mayEdit(context) : true),
    menu: { menu: 'edit', group: '2_clipboard', order: 3 },
  },
  {
    id: 'edit.delete',
    title: 'command.delete',
    icon: Trash2,
    keys: ['Del'],
    scope: 'tree',
    delegated: true,
    enabled: editsSelection,
    menu: { menu: 'edit', group: '2_clipboard', order: 4 },
  },
  {
    id: 'edit.selectAll',
    title: 'command.selectAll',
    keys: ['Ctrl+A'],
    scope: 'tree',
    delegated: true,
    menu: { menu: 'edit', group: '2_clipboard', order: 5 },
  },
  {
    id: 'edit.find',
    title: 'command.find',
    icon: Search,
    keys: ['Ctrl+F'],
    delegated: true,
    menu: { menu: 'edit', group: '3_find', order: 1 },
  },
  {
    id: 'edit.replace',
    title: 'command.replace',
    icon: Replace,
    keys: ['Ctrl+H'],
    delegated: true,
    menu: { menu: 'edit', group: '3_find', order: 2 },
  },
  {
    id: 'edit.rename',
    title: 'command.rename',
    icon: TextCursorInput,
    keys: ['F2'],
    scope: 'tree',
    menu: { menu: 'project', group: '1_objects', order: 4 },
    enabled: (context) => {
      const allowed = mayEdit(context);
      if (allowed !== true) return allowed;
      return context.selection.length === 1 ? true : 'reason.selectOne';
    },
    run: (context) => useTree.setState({ renaming: context.selection[0]!.id }),
  },
  {
    id: 'file.save',
    title: 'command.save',
    icon: Save,
    keys: ['Ctrl+S'],
    quiet: true,
    delegated: true,
    menu: { menu: 'file', group: '3_save', order: 1 },
    toolbar: { group: '1_file', order: 1 },
    enabled: (context) => (context.activeEditor?.dirty ? true : 'reason.nothingToSave'),
    run: async (context) => {
      if (context.activeEditor) await saveEditors([context.activeEditor.panelId]);
    },
  },
  {
    id: 'file.saveAll',
    title: 'command.saveAll',
    icon: SaveAll,
    keys: ['Ctrl+Shift+S'],
    quiet: true,
    menu: { menu: 'file', group: '3_save', order: 2 },
    enabled: (context) => (context.dirtyPanels.length > 0 ? true : 'reason.nothingToSave'),
    run: async (context) => {
      await saveEditors(context.dirtyPanels);
    },
  },
];

export function registerEditCommands(): void {
  registerCommands(commands);
  // A focused view that offers other acts changes what the Edit menu can do.
  useRegistry.setState((state) => ({ version: state.version + 1 }));
}
