/** The panels of watch lists, one each: Watch 1 to 4, and those of own lists as they come and go. */
import { CopyPlus, Eye, ListPlus, Pencil, Trash2 } from 'lucide-react';
import type { ComponentType } from 'react';
import { useProject } from '@/project/openProject';
import { contextChanged, registerCommands, type Command } from '@/workbench/commands';
import { project, when, type Condition } from '@/workbench/conditions';
import { closePanel } from '@/workbench/docking/dock';
import { registerPanel, registerPanelLoader, type PanelProps } from '@/workbench/panels';
import { findList, forgetLists, loadLists, useWatchLists } from './lists';
import { FIXED_LISTS, type WatchList } from './model';
import { askDelete, askListName, listActs, makeList, panelOf } from './ownLists';

/** Place of Watch 1 among the panels; the last place for watch lists is before that of the forces. */
const FIRST = 21;

const current = () => useWatchLists.getState().current;
const own: Condition = () => (findList(current())?.name == null ? 'watch.fixedList' : true);
const place = (order: number) => ({ menu: 'view' as const, group: '3_bottom', order, submenu: 'watch.menu' as const });

/** They act on the list used last. */
const commands: readonly Command[] = [
  {
    id: 'watch.newList',
    title: 'watch.newListMore',
    icon: ListPlus,
    menu: place(25.6),
    enabled: project,
    run: async () => void (await makeList()),
  },
  {
    id: 'watch.duplicateList',
    title: 'watch.duplicateListMore',
    icon: CopyPlus,
    menu: place(25.7),
    enabled: project,
    run: async () => void (await makeList(current())),
  },
  {
    id: 'watch.renameList',
    title: 'watch.renameListMore',
    icon: Pencil,
    menu: place(25.8),
    enabled: when(project, own),
    run: () => askListName(current()),
  },
  {
    id: 'watch.deleteList',
    title: 'watch.deleteList',
    icon: Trash2,
    menu: place(25.9),
    enabled: when(project, own),
    run: () => askDelete(current()),
  },
];

export function registerWatchLists(component: ComponentType<PanelProps>): void {
  const register = ({ id, name }: Pick<WatchList, 'id' | 'name'>, at: number) =>
    registerPanel({
      id: panelOf(id),
      ...(name === null
        ? { title: 'watch.title', titleValues: { number: id } }
        : { title: 'watch.ownTitle', titleValues: { name } }),
      icon: Eye,
      component,
      props: { list: id },
      position: 'bottom',
      order: name === null ? FIRST + at : FIRST + FIXED_LISTS.length + at / 10_000,
      initial: at === 0,
      submenu: 'watch.menu',
      entries: () => listActs(id),
    });
  FIXED_LISTS.forEach((id, at) => register({ id, name: null }, at));
  const registered = new Map<string, { name: string; dispose: () => void }>();
  const follow = () => {
    const { lists } = useWatchLists.getState();
    for (const [id, { dispose }] of registered) {
      if (lists.some((list) => list.id === id)) continue;
      closePanel(panelOf(id));
      dispose();
      registered.delete(id);
    }
    lists.forEach((list, at) => {
      if (list.name === null || registered.get(list.id)?.name === list.name) return;
      registered.set(list.id, { name: list.name, dispose: register(list, at) });
    });
  };
  const named = (lists: readonly WatchList[]) => lists.map((list) => `${list.id} ${list.name ?? ''}`).join('\n');
  useWatchLists.subscribe((now, before) => {
    if (now.lists !== before.lists && named(now.lists) !== named(before.lists)) follow();
    if (now.current !== before.current) contextChanged();
  });
  registerPanelLoader(loadLists);
  useProject.subscribe(({ projectId }, before) => {
    if (projectId === null && before.projectId !== null) forgetLists();
  });
  registerCommands(commands);
}
