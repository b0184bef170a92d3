/** The commands of history and comparison; their dialogs are loaded when they are first asked for. */
import { ArchiveRestore, GitCompareArrows, History } from 'lucide-react';
import type { ObjectSummary } from '@/api/types';
import { useProject } from '@/project/openProject';
import { openDialog } from '@/ui/dialogs';
import { registerCommands, type Command } from '@/workbench/commands';
import { project } from '@/workbench/conditions';
import type { CommandContext } from '@/workbench/context';
import { saveEditors } from '@/workbench/docking/close';

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
    title: 'command.history',
    icon: History,
    menu: { menu: 'project', group: '3_project', order: 1 },
    enabled: project,
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
];

function chosen(context: CommandContext): ObjectSummary | null {
  return context.selection.length === 1 ? context.selection[0]! : null;
}

export function registerCompare(): void {
  registerCommands(commands);
}
