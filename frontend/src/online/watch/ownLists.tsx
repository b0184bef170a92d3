/** Own watch lists: made, named, copied and deleted by the user. */
import { CopyPlus, ListPlus, Pencil, Trash2 } from 'lucide-react';
import { t } from '@/i18n';
import { confirm, openDialog } from '@/ui/dialogs';
import type { MenuEntry } from '@/ui/Menu';
import { showPanel } from '@/workbench/docking/dock';
import { ListNameDialog } from './ListNameDialog';
import { addToList, deleteList, findList, newList, renameList, setCurrentList, useWatchLists } from './lists';
import { freeName, listTitle } from './listTitle';

export const panelOf = (listId: string) => `watch${listId}`;

const titles = () => useWatchLists.getState().lists.map((list) => listTitle(t, list));

/** Asks for the name of a new list, empty or with the lines of another one, and shows it; null when cancelled. */
export async function makeList(from: string | null = null): Promise<string | null> {
  const copied = from === null ? undefined : findList(from);
  const name = await openDialog<string>((close) => (
    <ListNameDialog
      title={t(copied ? 'watch.duplicateList' : 'watch.newList')}
      action={t(copied ? 'watch.duplicate' : 'watch.create')}
      initial={freeName(copied ? listTitle(t, copied) : t('watch.newName'), titles())}
      own={null}
      close={close}
    />
  ));
  if (name === undefined) return null;
  const id = newList(name, from);
  showPanel(panelOf(id));
  return id;
}

export async function askListName(id: string): Promise<void> {
  const list = findList(id);
  if (list?.name == null) return;
  const name = await openDialog<string>((close) => (
    <ListNameDialog
      title={t('watch.renameList')}
      action={t('watch.rename')}
      initial={list.name ?? ''}
      own={id}
      close={close}
    />
  ));
  if (name !== undefined) renameList(id, name);
}

/** A list with lines is deleted after a question. */
export async function askDelete(id: string): Promise<void> {
  const list = findList(id);
  if (list?.name == null) return;
  const sure =
    list.entries.length === 0 ||
    (await confirm({
      title: t('watch.deleteTitle', { name: list.name }),
      text: t('watch.deleteText', { count: list.entries.length }),
      action: t('action.delete'),
      danger: true,
    }));
  if (sure) deleteList(id);
}

/** Puts expressions into a list, which comes to the front; null: into a new one. */
export async function addExpressions(expressions: readonly string[], listId: string | null): Promise<void> {
  const id = listId ?? (await makeList());
  if (id === null) return;
  addToList(id, expressions);
  setCurrentList(id);
  showPanel(panelOf(id), false);
}

/** What can be done with a list. */
export function listActs(id: string): MenuEntry[] {
  const fixed = findList(id)?.name == null ? t('watch.fixedList') : null;
  return [
    { kind: 'item', key: 'newList', text: t('watch.newListMore'), icon: ListPlus, run: () => void makeList() },
    {
      kind: 'item',
      key: 'duplicateList',
      text: t('watch.duplicateListMore'),
      icon: CopyPlus,
      run: () => void makeList(id),
    },
    {
      kind: 'item',
      key: 'renameList',
      text: t('watch.renameListMore'),
      icon: Pencil,
      disabledReason: fixed,
      run: () => void askListName(id),
    },
    {
      kind: 'item',
      key: 'deleteList',
      text: t('watch.deleteList'),
      icon: Trash2,
      danger: true,
      disabledReason: fixed,
      run: () => void askDelete(id),
    },
  ];
}

/** Entries that put something into one of the lists, or with null into a new one. */
export function addEntries(
  add: (listId: string | null) => Promise<void>,
  disabledReason: string | null = null,
): MenuEntry[] {
  const { lists, current } = useWatchLists.getState();
  const entry = (key: string, text: string, id: string | null): MenuEntry => ({
    kind: 'item',
    key,
    text,
    disabledReason,
    ...(id === null ? { icon: ListPlus } : { checked: id === current }),
    run: () => void add(id),
  });
  return [
    ...lists.map((list) => entry(`watch${list.id}`, listTitle(t, list), list.id)),
    { kind: 'line', key: 'line-new' },
    entry('new', t('watch.newListMore'), null),
  ];
}
