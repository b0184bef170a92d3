import { History } from 'lucide-react';
import { api } from '@/api/client';
import { t } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import { notify } from '@/ui/notices';
import { useProject } from '@/project/openProject';
import { registerCommands, type Command } from '../commands';
import { connected, engineer, idle, online, when } from '../conditions';
import type { CommandContext } from '../context';
import { saveEditors } from '../docking/close';
import { compareLogin } from '../online/relation';
import type { RestoreChoice } from '../online/VersionsDialog';
import { relationChanged, runtimePolled } from '../onlineSession';

const commands: Command[] = [
  {
    id: 'online.versions',
    title: 'command.versions',
    icon: History,
    menu: { menu: 'online', group: '2_load', order: 8 },
    enabled: when(online, connected, engineer, idle),
    run: versions,
  },
];

/** Shows what the controller had, and brings back what is chosen; the project stays as it is. */
async function versions(context: CommandContext): Promise<void> {
  if (!(await saveEditors(context.dirtyPanels))) return;
  const path = { project_id: context.projectId!, application_id: context.applicationId! };
  const { runtimeId, runtime } = context.online!;
  const [known, { VersionsDialog }] = await Promise.all([
    api.get('/api/v1/projects/{project_id}/applications/{application_id}/versions', {
      params: { path, query: { runtime_id: runtimeId } },
    }),
    import('../online/VersionsDialog'),
  ]);
  const running = runtime?.state === 'run';
  const choice = await openDialog<RestoreChoice>((close) => (
    <VersionsDialog
      projectId={path.project_id}
      applicationId={path.application_id}
      runtimeId={runtimeId}
      versions={known}
      running={running}
      close={close}
    />
  ));
  if (!choice) return;
  useProject.setState({ busy: { text: t('busy.restore') } });
  try {
    await api.post('/api/v1/projects/{project_id}/applications/{application_id}/versions/{code_id}/restore', {
      params: { path: { ...path, code_id: choice.codeId } },
      body: {
        runtime_id: runtimeId,
        mode: choice.mode,
        start: choice.start,
        initialise_persistent: choice.fresh,
      },
    });
  } finally {
    useProject.setState({ busy: null });
  }
  const { relation } = await compareLogin(path.project_id, path.application_id, runtimeId);
  relationChanged(path.application_id, relation);
  const at = { params: { path: { runtime_id: runtimeId } } };
  runtimePolled(runtimeId, await api.get('/api/v1/runtimes/{runtime_id}', at));
  notify({ tone: 'ok', title: t('versions.done'), text: t('versions.doneText') });
}

export function registerVersionCommands(): void {
  registerCommands(commands);
}
