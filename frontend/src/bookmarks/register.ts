/** Bookmarks: the panel and the commands. */
import { Bookmark, BookmarkX } from 'lucide-react';
import { partsOf } from '@/project/kinds';
import { onDemand } from '@/ui/onDemand';
import { contextChanged, registerCommands, type Command } from '@/workbench/commands';
import { editor, project, when, type Condition } from '@/workbench/conditions';
import { registerPanel } from '@/workbench/panels';
import { step, toggleAtCursor } from './acts';
import { clearBookmarks, followProject, useBookmarks } from './store';

const textEditor: Condition = ({ activeEditor }) =>
  activeEditor !== null && partsOf(activeEditor.kind).length > 0 ? true : 'bookmarks.noText';
const some: Condition = () => (useBookmarks.getState().bookmarks.length > 0 ? true : 'bookmarks.none');
const someHere: Condition = ({ activeEditor }) =>
  useBookmarks.getState().bookmarks.some(({ objectId }) => objectId === activeEditor?.objectId)
    ? true
    : 'bookmarks.noneHere';

const commands: readonly Omit<Command, 'menu'>[] = [
  {
    id: 'bookmarks.toggle',
    title: 'bookmarks.toggle',
    icon: Bookmark,
    keys: ['Ctrl+F12'],
    enabled: when(editor, textEditor),
    run: toggleAtCursor,
  },
  {
    id: 'bookmarks.next',
    title: 'bookmarks.next',
    keys: ['Ctrl+Alt+PageDown'],
    enabled: when(project, some),
    run: (context) => step(context, 1, false),
  },
  {
    id: 'bookmarks.previous',
    title: 'bookmarks.previous',
    keys: ['Ctrl+Alt+PageUp'],
    enabled: when(project, some),
    run: (context) => step(context, -1, false),
  },
  {
    id: 'bookmarks.nextHere',
    title: 'bookmarks.nextHere',
    enabled: when(editor, textEditor, someHere),
    run: (context) => step(context, 1, true),
  },
  {
    id: 'bookmarks.previousHere',
    title: 'bookmarks.previousHere',
    enabled: when(editor, textEditor, someHere),
    run: (context) => step(context, -1, true),
  },
  {
    id: 'bookmarks.clearHere',
    title: 'bookmarks.clearHere',
    enabled: when(editor, textEditor, someHere),
    run: ({ activeEditor }) => clearBookmarks(({ objectId }) => objectId === activeEditor?.objectId),
  },
  {
    id: 'bookmarks.clear',
    title: 'bookmarks.clear',
    icon: BookmarkX,
    enabled: when(project, some),
    run: () => clearBookmarks(() => true),
  },
];

export function registerBookmarks(): void {
  registerPanel({
    id: 'bookmarks',
    title: 'bookmarks.title',
    icon: Bookmark,
    component: onDemand(() => import('./BookmarksPanel')),
    position: 'bottom',
    order: 57,
  });
  registerBookmarkCommands();
  followProject();
  useBookmarks.subscribe(contextChanged);
}

export function registerBookmarkCommands(): void {
  registerCommands(
    commands.map((command, order) => ({
      ...command,
      menu: { menu: 'edit', group: '5_go_marks', order, submenu: 'bookmarks.title' },
    })),
  );
}
