import { FileInput, FileOutput } from 'lucide-react';
import { queryClient, runtimesQuery } from '@/api/queries';
import type { ProjectSummary } from '@/api/types';
import { go } from '@/session/route';
import { openDialog } from '@/ui/dialogs';
import { registerCommands, type Command } from '../commands';
import { connected, engineer, idle, online, when } from '../conditions';
import { downloadSource } from '../online/source';
import { leaveProject } from './file';

const commands: Command[] = [
  {
    id: 'file.sourceUpload',
    title: 'command.sourceUpload',
    icon: FileInput,
    menu: { menu: 'file', group: '2_exchange', order: 5 },
    enabled: engineer,
    run: async (context) => {
      const [runtimes, { SourceUploadDialog }] = await Promise.all([
        queryClient.fetchQuery({ ...runtimesQuery, staleTime: 0 }),
        import('../online/SourceUploadDialog'),
      ]);
      const project = await openDialog<ProjectSummary>((close) => (
        <SourceUploadDialog
          runtimes={runtimes}
          proposed={context.online?.runtimeId ?? context.runtimeId}
          close={close}
        />
      ));
      if (project && (await leaveProject())) go({ page: 'project', projectId: project.id });
    },
  },
  {
    id: 'online.sourceDownload',
    title: 'command.sourceDownload',
    icon: FileOutput,
    menu: { menu: 'online', group: '3_source', order: 1 },
    enabled: when(online, connected, engineer, idle),
    run: downloadSource,
  },
];

export function registerSourceCommands(): void {
  registerCommands(commands);
}
