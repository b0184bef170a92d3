/** Commands of the list of persistent variables; there only while it is the editor in front. */
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import { t } from '@/i18n';
import { notify, notifyError } from '@/ui/notices';
import type { Command } from '@/workbench/commands';
import { mayEdit } from '@/workbench/rights';
import { runCommand } from '@/workbench/run';

async function addInstancePaths(projectId: string, objectId: string, name: string): Promise<void> {
  await runCommand('file.save');
  const before = await api.get('/api/v1/projects/{project_id}/objects/{object_id}', {
    params: { path: { project_id: projectId, object_id: objectId } },
  });
  const after = await api.post('/api/v1/projects/{project_id}/objects/{object_id}/instance-paths', {
    params: { path: { project_id: projectId, object_id: objectId } },
  });
  if (after.revision === before.revision) {
    notify({ tone: 'info', title: t('persistent.nothingToAdd', { name }) });
    return;
  }
  await queryClient.invalidateQueries({ queryKey: keys.object(projectId, objectId) });
  notify({ tone: 'ok', title: t('persistent.added', { name }) });
}

export const commands: readonly Command[] = [
  {
    id: 'persistent.addInstancePaths',
    title: 'persistent.addInstancePaths',
    menu: { menu: 'edit', group: '8_persistent' },
    visible: (context) => context.activeEditor?.kind === 'persistent',
    enabled: mayEdit,
    run: async ({ projectId, activeEditor }) => {
      if (projectId === null || activeEditor?.kind !== 'persistent') return;
      const objects = queryClient.getQueryData<{ id: string; name: string }[]>(keys.objects(projectId)) ?? [];
      const name = objects.find(({ id }) => id === activeEditor.objectId)?.name ?? '';
      try {
        await addInstancePaths(projectId, activeEditor.objectId, name);
      } catch (error) {
        notifyError(error);
      }
    },
  },
];
