import { hasRole, kindOf, opensEditor } from '@/project/kinds';
import { Ban, CircleCheckBig, FilePlus2, FolderOpen, Info, ListTree, Settings2, SlidersHorizontal } from 'lucide-react';
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary, PlacementRule, ProjectObject } from '@/api/types';
import { AddObjectDialog } from '../addObject/AddObjectDialog';
import { registerCommands, type Command, type Enablement } from '../commands';
import { editor, project, selection, when } from '../conditions';
import type { CommandContext } from '../context';
import { openDialog } from '@/ui/dialogs';
import { openObject, showPanel } from '../docking/dock';
import { setActiveApplication } from '@/project/openProject';
import { excludeObjects } from '../properties/exclude';
import { mayEdit } from '../rights';
import { reasonText } from '../run';
import { forestOf, lineage, type TreeView } from '@/project/tree';
import { placeableKinds } from '@/project/placement';
import { revealInTree } from '../tree/state';

/** Argument of `project.addObject`; without one the selected object is the parent. */
interface AddOrder {
  kind?: string;
  parentId: string | null;
  view: TreeView;
}

function objectsOf(projectId: string): readonly ObjectSummary[] {
  return queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId)) ?? [];
}

/** Panel that shows an object: Devices or POUs. */
function viewOf(objects: readonly ObjectSummary[], id: string): TreeView {
  return hasRole(lineage(objects, id).at(-1), 'device') ? 'devices' : 'pous';
}

/** Brings an object into view in the tree that holds it. */
export function showInTree(projectId: string, id: string): void {
  showPanel(viewOf(objectsOf(projectId), id), false);
  revealInTree(id);
}

function excludable(context: CommandContext): Enablement {
  if (context.selection.length === 0) return 'reason.nothingSelected';
  return context.selection.every((object) => kindOf(object.kind)?.compiled) ? true : 'reason.notCompiled';
}

const commands: Command[] = [
  {
    id: 'project.addObject',
    title: 'command.addObject',
    icon: FilePlus2,
    keys: ['Alt+Insert'],
    menu: { menu: 'project', group: '1_objects', order: 1 },
    enabled: mayEdit,
    run: async (context, argument) => {
      const projectId = context.projectId!;
      const objects = objectsOf(projectId);
      const forest = forestOf(objects);
      const rules = queryClient.getQueryData<PlacementRule[]>(keys.placement) ?? [];
      const selected = context.selection[0];
      let order: AddOrder = (argument as AddOrder | undefined) ?? {
        parentId: selected?.id ?? context.applicationId,
        view: selected ? viewOf(objects, selected.id) : context.applicationId ? 'devices' : 'pous',
      };
      // Where nothing may be below the selected object, its parents are asked: Add Object on a GVL adds beside it.
      while (order.parentId && placeableKinds(rules, forest, order.parentId, order.view).length === 0) {
        order = { ...order, parentId: forest.byId.get(order.parentId)?.parent_id ?? null };
      }
      const { kind, parentId, view } = order;
      const created = await openDialog<ProjectObject>((close) => (
        <AddObjectDialog
          projectId={projectId}
          forest={forest}
          rules={rules}
          view={view}
          parentId={parentId}
          kind={kind}
          close={close}
        />
      ));
      if (!created) return;
      showInTree(projectId, created.id);
      if (opensEditor(created)) openObject(created.id, created.name);
    },
  },
  {
    id: 'project.openObject',
    title: 'command.openObject',
    icon: FolderOpen,
    menu: { menu: 'project', group: '1_objects', order: 2 },
    enabled: selection,
    run: (context) => context.selection.forEach((object) => openObject(object.id, object.name)),
  },
  {
    id: 'project.showInTree',
    title: 'command.showInTree',
    icon: ListTree,
    menu: { menu: 'project', group: '1_objects', order: 3 },
    enabled: editor,
    run: (context) => showInTree(context.projectId!, context.activeEditor!.objectId),
  },
  {
    id: 'project.setActive',
    title: 'command.setActive',
    icon: CircleCheckBig,
    menu: { menu: 'project', group: '2_application' },
    visible: (context) => hasRole(context.selection[0], 'application'),
    enabled: (context) => (context.selection[0]?.id === context.applicationId ? 'reason.activeAlready' : true),
    run: (context) => setActiveApplication(context.selection[0]!.id),
  },
  {
    id: 'project.exclude',
    title: 'command.exclude',
    icon: Ban,
    menu: { menu: 'project', group: '1_objects', order: 4 },
    checked: (context) => context.selection.length > 0 && context.selection.every((object) => object.excluded),
    enabled: when(mayEdit, excludable),
    // When all of them are out already, they come in again.
    run: ({ projectId, selection: objects }) =>
      excludeObjects(projectId!, objects, !objects.every((object) => object.excluded)),
  },
  {
    id: 'project.properties',
    title: 'command.properties',
    icon: SlidersHorizontal,
    keys: ['Alt+Enter'],
    scope: 'tree',
    menu: { menu: 'project', group: '1_objects', order: 5 },
    enabled: selection,
    run: async (context) => {
      const { PropertiesDialog } = await import('../properties/PropertiesDialog');
      await openDialog((close) => (
        <PropertiesDialog projectId={context.projectId!} object={context.selection[0]!} close={() => close()} />
      ));
    },
  },
  {
    id: 'project.settings',
    title: 'command.projectSettings',
    icon: Settings2,
    menu: { menu: 'project', group: '3_project', order: 1 },
    enabled: project,
    run: async (context) => {
      const { ProjectSettingsDialog } = await import('../projectSettings/ProjectSettingsDialog');
      const allowed = mayEdit(context);
      await openDialog((close) => (
        <ProjectSettingsDialog
          projectId={context.projectId!}
          readOnly={allowed === true ? null : reasonText(allowed)}
          close={() => close()}
        />
      ));
    },
  },
  {
    id: 'project.information',
    title: 'command.projectInformation',
    icon: Info,
    menu: { menu: 'project', group: '3_project', order: 2 },
    enabled: project,
    run: async (context) => {
      const { ProjectInfoDialog } = await import('../projectInfo/ProjectInfoDialog');
      await openDialog((close) => <ProjectInfoDialog projectId={context.projectId!} close={() => close()} />);
    },
  },
];

export function registerProjectCommands(): void {
  registerCommands(commands);
}
