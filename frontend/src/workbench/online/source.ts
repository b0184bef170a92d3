/** The source of the project in the controller: stored with a download or by a command, read back. */
import { api } from '@/api/client';
import { shaped } from '@/api/objects';
import { objectQuery, queryClient } from '@/api/queries';
import { t } from '@/i18n';
import { ofRole } from '@/project/kinds';
import { useProject } from '@/project/openProject';
import { confirm } from '@/ui/dialogs';
import { notify } from '@/ui/notices';
import type { CommandContext } from '../context';
import { saveEditors } from '../docking/close';

/** What a download says about the source: true or false where the user was asked, null for what is set. */
export async function sourceWanted(context: CommandContext): Promise<boolean | null> {
  const stored = await queryClient.ensureQueryData(objectQuery(context.projectId!, context.applicationId!));
  if (shaped(stored, ofRole('application')).data.source_download !== 'prompt') return null;
  return confirm({ title: t('source.ask'), text: t('source.askText'), action: t('source.store') });
}

/** Why the source did not come along with a download that was done. */
export function tellSourceProblem(problem: string | null): void {
  if (problem !== null) notify({ tone: 'warn', title: t('source.notStored'), text: problem });
}

/** Stores the source of the project as it is now. */
export async function downloadSource(context: CommandContext): Promise<void> {
  if (!(await saveEditors(context.dirtyPanels))) return;
  const runtimeId = context.online!.runtimeId;
  const sure = await confirm({
    title: t('source.downloadTitle', { runtime: context.online!.runtime?.name ?? '' }),
    text: t('source.downloadText'),
    action: t('source.store'),
  });
  if (!sure) return;
  await api.post('/api/v1/projects/{project_id}/applications/{application_id}/source-download', {
    params: { path: { project_id: context.projectId!, application_id: context.applicationId! } },
    body: { runtime_id: runtimeId },
  });
  notify({ tone: 'ok', title: t('source.stored', { project: useProject.getState().projectName }) });
}
