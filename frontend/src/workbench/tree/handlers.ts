/** What copy, paste, delete and so on mean while a tree has the focus. */
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary, PlacementRule } from '@/api/types';
import { t } from '@/i18n';
import type { Enablement, Handlers } from '../commands';
import { commandContext } from '../context';
import { confirm } from '@/ui/dialogs';
import { notify } from '@/ui/notices';
import { selectObjects, useSelection } from '../selection';
import { copyObject, deleteObjects, moveObject, undoChange } from './acts';
import { childrenOf, forestOf, subtree, topMost, type Forest, type TreeView } from '@/project/tree';
import { displayName } from '@/project/objectName';
import { mayDrop } from '@/project/placement';
import { actionText } from './actionText';
import { revealInTree, useTree } from './state';

function present(projectId: string): Forest {
  return forestOf(queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId)) ?? []);
}

function chosen(forest: Forest): string[] {
  return topMost(
    forest,
    useSelection.getState().objectIds.filter((id) => forest.byId.has(id)),
  );
}

export function treeHandlers(projectId: string, view: TreeView, rules: readonly PlacementRule[]): Handlers {
  return {
    'edit.undo': { run: () => stepBack(projectId, 'undo') },
    'edit.redo': { run: () => stepBack(projectId, 'redo') },
    'edit.cut': { run: () => useTree.setState({ clipboard: { ids: chosen(present(projectId)), cut: true } }) },
    'edit.copy': { run: () => useTree.setState({ clipboard: { ids: chosen(present(projectId)), cut: false } }) },
    'edit.paste': { run: () => pasteInto(projectId, view, rules) },
    'edit.delete': { run: () => deleteChosen(projectId) },
    'edit.selectAll': {
      run: () => {
        const forest = present(projectId);
        const first = forest.byId.get(useSelection.getState().objectIds[0] ?? '');
        selectObjects(childrenOf(forest, first?.parent_id ?? null).map((object) => object.id));
      },
    },
  };
}

/**
 * Where a paste goes: into the selected object, or beside it where it cannot hold what is pasted.
 * Undefined when it fits nowhere.
 */
function pasteTarget(forest: Forest, view: TreeView, rules: readonly PlacementRule[]): string | null | undefined {
  const { clipboard } = useTree.getState();
  if (!clipboard) return undefined;
  const first = forest.byId.get(useSelection.getState().objectIds[0] ?? '');
  const candidates = first ? [first.id, first.parent_id] : [null];
  return candidates.find((parent) => mayDrop(rules, forest, clipboard.ids, parent, view, !clipboard.cut));
}

/** Why Paste is not possible here, or true. */
export function pasteEnablement(forest: Forest, view: TreeView, rules: readonly PlacementRule[]): Enablement {
  const { clipboard } = useTree.getState();
  if (!clipboard) return 'reason.emptyClipboard';
  return pasteTarget(forest, view, rules) === undefined ? 'reason.pasteNotHere' : true;
}

export async function pasteInto(projectId: string, view: TreeView, rules: readonly PlacementRule[]): Promise<void> {
  const { clipboard } = useTree.getState();
  const forest = present(projectId);
  const parent = pasteTarget(forest, view, rules);
  if (!clipboard || parent === undefined)
    throw new Error(t(clipboard ? 'reason.pasteNotHere' : 'reason.emptyClipboard'));
  let last: string | undefined;
  for (const id of clipboard.ids) {
    const object = forest.byId.get(id);
    if (!object) continue;
    if (clipboard.cut) {
      await moveObject(projectId, object, parent, childrenOf(forest, parent).length);
      last = id;
    } else last = (await copyObject(projectId, id, parent)).id;
  }
  if (clipboard.cut) useTree.setState({ clipboard: null });
  if (last) revealInTree(last);
}

/** Goes back over the last change of the tree by this user, or over what was undone last. */
async function stepBack(projectId: string, way: 'undo' | 'redo'): Promise<void> {
  const { done, touched } = await undoChange(projectId, way);
  const [first, ...others] = done.objects;
  const name = others.length > 0 ? t('undo.several', { count: done.objects.length }) : (first ?? '');
  notify({ tone: 'ok', title: t(`undo.${way}`, { action: actionText(done.action), name }) });
  const shown = touched.find((id) => present(projectId).byId.has(id));
  if (shown) revealInTree(shown);
}

/** Asks, then deletes the selected objects with everything below them. */
async function deleteChosen(projectId: string): Promise<void> {
  const forest = present(projectId);
  const ids = chosen(forest);
  if (ids.length === 0 || commandContext().online) return;
  const below = ids.reduce((count, id) => count + subtree(forest, id).length - 1, 0);
  const name = displayName(forest.byId.get(ids[0]!)!);
  const sure = await confirm({
    title: ids.length === 1 ? t('delete.title', { name }) : t('delete.titleMany', { count: ids.length }),
    text: below > 0 ? t('delete.textBelow', { count: below }) : t('delete.text'),
    action: t('action.delete'),
    danger: true,
  });
  if (!sure) return;
  const first = forest.byId.get(ids[0]!)!;
  const siblings = childrenOf(forest, first.parent_id).filter((object) => !ids.includes(object.id));
  const next = siblings.find((object) => object.index > first.index) ?? siblings.at(-1);
  await deleteObjects(projectId, ids);
  const focus = next?.id ?? first.parent_id;
  if (focus) revealInTree(focus);
}
