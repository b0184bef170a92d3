import type { PlacementRule } from '@/api/types';
import { t } from '@/i18n';
import { kindTitle, objectIcon } from '@/project/kinds';
import { keysText } from '../keys';
import { findCommand, useRegistry } from '../commands';
import { commandContext, type CommandContext } from '../context';
import { guard } from '@/ui/notices';
import { entriesOf } from '../frame/menuEntries';
import { reasonText, runCommand } from '../run';
import { mayEdit } from '../rights';
import type { MenuEntry } from '@/ui/Menu';
import { pasteEnablement } from './handlers';
import type { Forest, TreeView } from '@/project/tree';
import { placeableKinds } from '@/project/placement';

interface TreeMenuOptions {
  view: TreeView;
  forest: Forest;
  rules: readonly PlacementRule[];
  paste: () => Promise<void>;
}

/** The context menu of a tree: for the selected objects, or for the view itself on its background. */
export function treeEntries({ view, forest, rules, paste }: TreeMenuOptions): MenuEntry[] {
  const { commands } = useRegistry.getState();
  const context = commandContext();
  const [object] = context.selection;
  const single = context.selection.length === 1;
  const edit = ['edit.cut', 'edit.copy'];
  const pasteCommand = findCommand('edit.paste');
  const pasteRefusal = mayEdit(context) === true ? pasteEnablement(forest, view, rules) : mayEdit(context);
  const pasteEntry: MenuEntry = {
    kind: 'item',
    key: 'paste',
    text: t('command.paste'),
    icon: pasteCommand?.icon,
    shortcut: pasteCommand?.keys?.[0] && keysText(pasteCommand.keys[0]),
    disabledReason: pasteRefusal === true ? null : reasonText(pasteRefusal),
    run: () => void guard(paste),
  };
  const add = addEntries(view, forest, rules, context);
  if (!object) return [...add, ...(add.length ? [{ kind: 'line', key: 'line-add' } as const] : []), pasteEntry];
  return [
    ...entriesOf(single ? ['project.openObject', 'project.setActive', null] : [], commands, context),
    ...(single && add.length ? [{ kind: 'line', key: 'line-open' } as const, ...add] : []),
    { kind: 'line', key: 'line-edit' },
    ...entriesOf(edit, commands, context),
    pasteEntry,
    ...entriesOf(
      ['edit.delete', 'edit.rename', null, 'project.exclude', 'object.history', 'project.properties'],
      commands,
      context,
    ),
  ];
}

/** Add Object with the kinds that may be here. */
function addEntries(
  view: TreeView,
  forest: Forest,
  rules: readonly PlacementRule[],
  context: CommandContext,
): MenuEntry[] {
  if (context.selection.length > 1 || mayEdit(context) !== true) return [];
  const parentId = context.selection[0]?.id ?? null;
  const kinds = placeableKinds(rules, forest, parentId, view);
  if (kinds.length === 0) return [];
  const entries: MenuEntry[] = kinds.map((rule) => ({
    kind: 'item',
    key: rule.kind,
    text: kindTitle(rule.kind),
    icon: objectIcon(rule.kind),
    run: () => void runCommand('project.addObject', { kind: rule.kind, parentId, view }),
  }));
  return [
    { kind: 'sub', key: 'add', text: t('command.addObject'), icon: findCommand('project.addObject')?.icon, entries },
  ];
}
