import { CircleCheckBig, FilePlus2, FolderOpen, History, Info, ListTree } from 'lucide-react';
import { keys, queryClient } from '@/api/queries';
import type { ObjectKind, ObjectSummary, PlacementRule, ProjectObject } from '@/api/types';
import { AddObjectDialog } from '../addObject/AddObjectDialog';
import { registerCommands, type Command } from '../commands';
import { openDialog } from '../dialogs';
import { openObject, showPanel } from '../docking/dock';
import { HistoryDialog } from '../history/HistoryDialog';
import { setActiveApplication } from '../project';
import { ProjectInfoDialog } from '../projectInfo/ProjectInfoDialog';
import { mayEdit } from '../rights';
import { forestOf, lineage, type TreeView } from '../tree/model';
import { placeableKinds } from '../tree/placement';
import { revealInTree } from '../tree/state';

/** Argument of `project.addObject`; without one the selected object is the parent. */
interface AddOrder {
  kind?: ObjectKind;
  parentId: string | null;
  view: TreeView;
}

function objectsOf(projectId: string): readonly ObjectSummary[] {
  return queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId)) ?? [];
}

/** Panel that shows an object: Devices or POUs. */
export function viewOf(objects: readonly ObjectSummary[], id: string): TreeView {
  return lineage(objects, id).at(-1)?.kind === 'device' ? 'devices' : 'pous';
}

/** Brings an object into view in the tree that holds it. */
export function showInTree(projectId: string, id: string): void {
  showPanel(viewOf(objectsOf(projectId), id), false);
  revealInTree(id);
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
      if (created.kind !== 'folder' && created.kind !== 'plc_logic') openObject(created.id, created.name);
    },
  },
  {
    id: 'project.openObject',
    title: 'command.openObject',
    icon: FolderOpen,
    menu: { menu: 'project', group: '1_objects', order: 2 },
    enabled: (context) => (context.selection.length > 0 ? true : 'reason.nothingSelected'),
    run: (context) => context.selection.forEach((object) => openObject(object.id, object.name)),
  },
  {
    id: 'project.showInTree',
    title: 'command.showInTree',
    icon: ListTree,
    menu: { menu: 'project', group: '1_objects', order: 3 },
    enabled: (context) => (context.activeEditor ? true : 'reason.noEditor'),
    run: (context) => showInTree(context.projectId!, context.activeEditor!.objectId),
  },
  {
    id: 'project.setActive',
    title: 'command.setActive',
    icon: CircleCheckBig,
    menu: { menu: 'project', group: '2_application' },
    visible: (context) => context.selection[0]?.kind === 'application',
    enabled: (context) => (context.selection[0]?.id === context.applicationId ? 'reason.activeAlready' : true),
    run: (context) => setActiveApplication(context.selection[0]!.id),
  },
  {
    id: 'project.history',
    title: 'command.history',
    icon: History,
    menu: { menu: 'project', group: '3_project', order: 1 },
    enabled: (context) => (context.projectId ? true : 'reason.noProject'),
    run: async (context) => {
      const object = context.selection.length === 1 ? context.selection[0]! : null;
      await openDialog((close) => (
        <HistoryDialog projectId={context.projectId!} object={object} close={() => close()} />
      ));
    },
  },
  {
    id: 'project.information',
    title: 'command.projectInformation',
    icon: Info,
    menu: { menu: 'project', group: '3_project', order: 2 },
    enabled: (context) => (context.projectId ? true : 'reason.noProject'),
    run: async (context) => {
      await openDialog((close) => <ProjectInfoDialog projectId={context.projectId!} close={() => close()} />);
    },
  },
];

export function registerProjectCommands(): void {
  registerCommands(commands);
}
