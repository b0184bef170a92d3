/** The commands of history and comparison; their dialogs are loaded when they are first asked for. */
import { ArchiveRestore, GitCompareArrows, History } from 'lucide-react';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { useProject } from '@/project/openProject';
import { openDialog } from '@/ui/dialogs';
import { registerCommands, type Command } from '@/workbench/commands';
import { application, project, when } from '@/workbench/conditions';
import type { CommandContext } from '@/workbench/context';
import { saveEditors } from '@/workbench/docking/close';
import { useKnownRelation } from '@/workbench/online/knownRelation';

async function openHistory(context: CommandContext, object: ObjectSummary | null, deleted = false): Promise<void> {
  if (!(await saveEditors(context.dirtyPanels))) return;
  const { HistoryDialog } = await import('./HistoryDialog');
  await openDialog((close) => (
    <HistoryDialog projectId={context.projectId!} object={object} deleted={deleted} close={() => close()} />
  ));
}

const commands: Command[] = [
  {
    id: 'project.history',
    title: 'command.projectHistory',
    icon: History,
    menu: { menu: 'project', group: '3_project', order: 1 },
    enabled: project,
    run: (context) => openHistory(context, null),
  },
  {
    id: 'object.history',
    title: 'command.history',
    icon: History,
    menu: { menu: 'project', group: '3_project', order: 1.1 },
    enabled: when(project, ({ selection, activeEditor }) =>
      selection.length === 1 || activeEditor ? true : 'reason.selectOne',
    ),
    run: (context, object) => openHistory(context, (object as ObjectSummary | undefined) ?? chosen(context)),
  },
  {
    id: 'project.deletedObjects',
    title: 'command.deletedObjects',
    icon: ArchiveRestore,
    menu: { menu: 'project', group: '3_project', order: 1.2 },
    enabled: project,
    run: (context) => openHistory(context, null, true),
  },
  {
    id: 'project.compare',
    title: 'command.compare',
    icon: GitCompareArrows,
    menu: { menu: 'project', group: '3_project', order: 1.5 },
    enabled: project,
    run: async (context) => {
      if (!(await saveEditors(context.dirtyPanels))) return;
      const { CompareDialog } = await import('./CompareDialog');
      await openDialog((close) => (
        <CompareDialog
          projectId={context.projectId!}
          projectName={useProject.getState().projectName}
          runtimeId={context.runtimeId}
          close={() => close()}
        />
      ));
    },
  },
  {
    id: 'online.compareRunning',
    title: 'command.compareRunning',
    icon: GitCompareArrows,
    menu: { menu: 'online', group: '2_load', order: 9 },
    enabled: when(application, (context) => (runningAt(context) === null ? 'compare.missing.runtime' : true)),
    run: async (context) => {
      if (!(await saveEditors(context.dirtyPanels))) return;
      const runtimeId = runningAt(context)!;
      const found = await api.post('/api/v1/projects/{project_id}/comparisons', {
        params: { path: { project_id: context.projectId! } },
        body: { old: { kind: 'runtime', runtime_id: runtimeId } },
      });
      const { CompareDialog } = await import('./CompareDialog');
      const projectName = useProject.getState().projectName;
      await openDialog((close) => (
        <CompareDialog
          projectId={context.projectId!}
          projectName={projectName}
          runtimeId={runtimeId}
          found={found}
          close={() => close()}
        />
      ));
    },
  },
];

/** The runtime whose application is meant: that of the login, else the one that was compared last, or chosen. */
function runningAt({ online, applicationId, runtimeId }: CommandContext): string | null {
  const known = applicationId ? useKnownRelation.getState().known[applicationId] : undefined;
  return online?.runtimeId ?? known?.runtimeId ?? runtimeId;
}

/** The object selected in the tree, or that of the editor in use. */
function chosen({ projectId, selection, activeEditor }: CommandContext): ObjectSummary | null {
  if (selection.length === 1) return selection[0]!;
  const objects = queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId!)) ?? [];
  return objects.find((object) => object.id === activeEditor?.objectId) ?? null;
}

export function registerCompare(): void {
  registerCommands(commands);
}
