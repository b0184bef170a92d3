import { FileCog, FileDown, FileUp, Printer } from 'lucide-react';
import { shaped } from '@/api/objects';
import { keys, objectQuery, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { go } from '@/session/route';
import { registerCommands, type Command } from '../commands';
import { project } from '../conditions';
import type { CommandContext } from '../context';
import { Dialog } from '@/ui/Dialog';
import { openDialog } from '@/ui/dialogs';
import { t } from '@/i18n';
import { saveEditors } from '../docking/close';
import { openObject } from '../docking/dock';
import { ExportDialog } from '../exchange/ExportDialog';
import { hasRole, kindWithRole, ofRole } from '@/project/kinds';
import { useProject } from '@/project/openProject';
import { mayEdit } from '../rights';
import { reasonText, runCommand } from '../run';
import { createObject } from '../tree/acts';
import { leaveProject } from './file';
import { showInTree } from './project';

function objectsOf(projectId: string): readonly ObjectSummary[] {
  return queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId)) ?? [];
}

/** There is one at most. */
function pageSetupOf({ projectId }: CommandContext): ObjectSummary | undefined {
  return projectId ? objectsOf(projectId).find((object) => hasRole(object, 'page-setup')) : undefined;
}

const commands: Command[] = [
  {
    id: 'file.import',
    title: 'command.import',
    icon: FileUp,
    menu: { menu: 'file', group: '2_exchange', order: 1 },
    enabled: mayEdit,
    run: async (context) => {
      const projectId = context.projectId!;
      const objects = objectsOf(projectId);
      const { ImportDialog } = await import('../exchange/ImportDialog');
      await openDialog((close) => (
        <ImportDialog
          target={{
            projectId,
            projectName: useProject.getState().projectName,
            objects,
            selected: context.selection[0],
            applicationId: context.applicationId,
          }}
          openObject={(entry) => {
            showInTree(projectId, entry.object_id!);
            openObject(entry.object_id!, entry.object.split('.').at(-1) ?? '');
          }}
          openProject={(id) => {
            void leaveProject().then((left) => left && go({ page: 'project', projectId: id }));
          }}
          close={() => close()}
        />
      ));
    },
  },
  {
    id: 'file.export',
    title: 'command.export',
    icon: FileDown,
    menu: { menu: 'file', group: '2_exchange', order: 2 },
    enabled: project,
    run: async (context) => {
      if (!(await saveEditors(context.dirtyPanels))) return;
      await openDialog((close) => (
        <ExportDialog
          projectId={context.projectId!}
          projectName={useProject.getState().projectName}
          objects={objectsOf(context.projectId!)}
          selection={context.selection}
          close={() => close()}
        />
      ));
    },
  },
  {
    id: 'file.print',
    title: 'command.print',
    icon: Printer,
    menu: { menu: 'file', group: '2_exchange', order: 3 },
    enabled: project,
    run: async (context) => {
      if (!(await saveEditors(context.dirtyPanels))) return;
      const { PrintDialog } = await import('../documentation/PrintDialog');
      const objects = objectsOf(context.projectId!);
      const setup = pageSetupOf(context);
      const detail =
        setup && shaped(await queryClient.fetchQuery(objectQuery(context.projectId!, setup.id)), ofRole('page-setup'));
      await openDialog((close) => (
        <PrintDialog
          projectId={context.projectId!}
          projectName={useProject.getState().projectName}
          objects={objects}
          selection={context.selection}
          current={objects.find(({ id }) => id === context.activeEditor?.objectId) ?? null}
          setup={detail?.data}
          openSetup={() => void runCommand('file.pageSetup')}
          close={() => close()}
        />
      ));
    },
  },
  {
    id: 'file.pageSetup',
    title: 'command.pageSetup',
    icon: FileCog,
    menu: { menu: 'file', group: '2_exchange', order: 4 },
    enabled: project,
    run: async (context) => {
      const { kind, usual: Usual } = kindWithRole('page-setup')!;
      const known = pageSetupOf(context);
      const allowed = mayEdit(context);
      if (known === undefined && allowed !== true && Usual !== undefined) {
        await openDialog((close) => (
          <Dialog title={t('command.pageSetup')} width={960} onClose={() => close()}>
            <Usual readOnly={reasonText(allowed)} />
          </Dialog>
        ));
        return;
      }
      const setup = known ?? (await createObject(context.projectId!, { kind, parent_id: null, name: null }));
      showInTree(context.projectId!, setup.id);
      openObject(setup.id, setup.name);
    },
  },
];

export function registerExchangeCommands(): void {
  registerCommands(commands);
}
