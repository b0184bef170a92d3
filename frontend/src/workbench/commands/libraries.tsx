import { LibraryBig, PackageCheck } from 'lucide-react';
import { librariesQuery, projectQuery, queryClient } from '@/api/queries';
import { t } from '@/i18n';
import { registerCommands, type Command } from '../commands';
import { engineer, project, when } from '../conditions';
import { openDialog } from '@/ui/dialogs';
import { saveEditors } from '../docking/close';
import { atLeast } from '../rights';

const commands: Command[] = [
  {
    id: 'file.saveLibrary',
    title: 'command.saveLibrary',
    icon: PackageCheck,
    menu: { menu: 'file', group: '2_exchange', order: 3 },
    enabled: when(project, engineer),
    run: async (context) => {
      if (!(await saveEditors(context.dirtyPanels))) return;
      const project = await queryClient.fetchQuery({ ...projectQuery(context.projectId!), staleTime: 0 });
      const installed = await queryClient.fetchQuery({ ...librariesQuery, staleTime: 0 });
      const { SaveLibraryDialog } = await import('../libraries/SaveLibraryDialog');
      await openDialog((close) => (
        <SaveLibraryDialog
          projectId={project.id}
          projectName={project.name}
          description={project.description}
          installed={installed}
          close={() => close()}
        />
      ));
    },
  },
  {
    id: 'tools.libraryRepository',
    title: 'command.libraryRepository',
    icon: LibraryBig,
    menu: { menu: 'tools', group: '1_options', order: 2 },
    run: async (context) => {
      const readOnly = atLeast(context.role, 'engineer') ? null : t('reason.engineer');
      const { RepositoryDialog } = await import('../libraries/RepositoryDialog');
      await openDialog((close) => <RepositoryDialog readOnly={readOnly} close={() => close()} />);
    },
  },
];

export function registerLibraryCommands(): void {
  registerCommands(commands);
}
