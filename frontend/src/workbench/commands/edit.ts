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
import { menuGroup, registerCommands, useRegistry, type Command } from '../commands';
import { selection, when, type Condition } from '../conditions';
import type { CommandContext } from '../context';
import { saveEditors } from '../docking/close';
import { mayEdit } from '../rights';
import { useTree } from '../tree/state';

/** Cut, delete and rename change the project when a tree has the focus; in an editor they are the editor's affair. */
const editsSelection: Condition = (context) => (inTree(context) ? when(mayEdit, selection)(context) : true);

function inTree(context: CommandContext): boolean {
  return context.focusedPanel === 'devices' || context.focusedPanel === 'pous';
}

/** In a tree, undo goes back over changes of the project, never over the text of an editor. */
const editsTree: Condition = (context) => (inTree(context) ? mayEdit(context) : true);

const commands: Command[] = [
  ...menuGroup(
    'edit',
    '1_undo',
    {
      id: 'edit.undo',
      title: 'command.undo',
      icon: Undo2,
      keys: ['Ctrl+Z'],
      delegated: true,
      enabled: editsTree,
    },
    {
      id: 'edit.redo',
      title: 'command.redo',
      icon: Redo2,
      keys: ['Ctrl+Y', 'Ctrl+Shift+Z'],
      delegated: true,
      enabled: editsTree,
    },
  ),
  ...menuGroup(
    'edit',
    '2_clipboard',
    {
      id: 'edit.cut',
      title: 'command.cut',
      icon: Scissors,
      keys: ['Ctrl+X'],
      scope: 'tree',
      delegated: true,
      enabled: editsSelection,
    },
    {
      id: 'edit.copy',
      title: 'command.copy',
      icon: Copy,
      keys: ['Ctrl+C'],
      scope: 'tree',
      delegated: true,
      enabled: (context) => (inTree(context) ? selection(context) : true),
    },
    {
      id: 'edit.paste',
      title: 'command.paste',
      icon: ClipboardPaste,
      keys: ['Ctrl+V'],
      scope: 'tree',
      delegated: true,
      enabled: editsTree,
    },
    {
      id: 'edit.delete',
      title: 'command.delete',
      icon: Trash2,
      keys: ['Del'],
      scope: 'tree',
      delegated: true,
      enabled: editsSelection,
    },
    {
      id: 'edit.selectAll',
      title: 'command.selectAll',
      keys: ['Ctrl+A'],
      scope: 'tree',
      delegated: true,
    },
  ),
  ...menuGroup(
    'edit',
    '3_find',
    {
      id: 'edit.find',
      title: 'command.find',
      icon: Search,
      keys: ['Ctrl+F'],
      delegated: true,
    },
    {
      id: 'edit.replace',
      title: 'command.replace',
      icon: Replace,
      keys: ['Ctrl+H'],
      delegated: true,
    },
  ),
  {
    id: 'edit.rename',
    title: 'command.rename',
    icon: TextCursorInput,
    keys: ['F2'],
    scope: 'tree',
    menu: { menu: 'project', group: '1_objects', order: 4 },
    enabled: when(mayEdit, (context) => (context.selection.length === 1 ? true : 'reason.selectOne')),
    run: (context) => useTree.setState({ renaming: context.selection[0]!.id }),
  },
  ...menuGroup(
    'file',
    '3_save',
    {
      id: 'file.save',
      title: 'command.save',
      icon: Save,
      keys: ['Ctrl+S'],
      quiet: true,
      delegated: true,
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
      enabled: (context) => (context.dirtyPanels.length > 0 ? true : 'reason.nothingToSave'),
      run: async (context) => {
        await saveEditors(context.dirtyPanels);
      },
    },
  ),
];

export function registerEditCommands(): void {
  registerCommands(commands);
  // A focused view that offers other acts changes what the Edit menu can do.
  useRegistry.setState((state) => ({ version: state.version + 1 }));
}
