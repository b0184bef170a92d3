/** `Do not report this warning` of the message list: switches its code off in the application of its object. */
import { shaped } from '@/api/objects';
import { keys, objectQuery, queryClient, saveObject } from '@/api/queries';
import type { Diagnostic, ObjectSummary } from '@/api/types';
import { t } from '@/i18n';
import { hasRole, ofRole } from '@/project/kinds';
import { lineage } from '@/project/tree';
import { guard, notify } from '@/ui/notices';
import { isCompilerWarning, switched } from '../compilerWarnings/model';
import { commandContext } from '../context';
import { mayEdit } from '../rights';
import { reasonText } from '../run';
import { forgetCode } from './store';

export function canBeSwitchedOff({ code, severity }: Diagnostic): boolean {
  return isCompilerWarning(code, severity);
}

/** The application of the message's object; of objects that several share, the active one. */
function applicationOf(message: Diagnostic): string | null {
  const { projectId, applicationId } = commandContext();
  if (!projectId || message.object_id === null) return applicationId;
  const objects = queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId)) ?? [];
  const own = lineage(objects, message.object_id).find((object) => hasRole(object, 'application'));
  return own?.id ?? applicationId;
}

/** Why it cannot be switched off now, or null. */
export function refusedToSwitchOff(message: Diagnostic): string | null {
  const allowed = mayEdit(commandContext());
  if (allowed !== true) return reasonText(allowed);
  return applicationOf(message) === null ? t('reason.noApplication') : null;
}

export async function switchOff(message: Diagnostic): Promise<void> {
  const { projectId } = commandContext();
  const applicationId = applicationOf(message);
  if (!projectId || applicationId === null) return;
  await guard(async () => {
    const stored = await queryClient.fetchQuery({ ...objectQuery(projectId, applicationId), staleTime: 0 });
    const { data, revision, name } = shaped(stored, ofRole('application'));
    const disabled_warnings = switched(data.disabled_warnings ?? [], [message.code], false);
    await saveObject(projectId, applicationId, revision, { ...data, disabled_warnings });
    forgetCode(message.code);
    notify({
      tone: 'info',
      title: t('warnings.notReported', { code: message.code, name }),
      text: t('warnings.undoHint'),
    });
  });
}
