import { t } from '@/i18n';
import { notify } from '@/ui/notices';
import { isRecording, useOnline } from '@/workbench/onlineSession';

/** Whether a runtime's views show the past, in which nothing can be written; says so. */
export function refusePast(runtimeId: string): boolean {
  const sessions = Object.values(useOnline.getState().sessions);
  if (isRecording(runtimeId)) {
    notify({ tone: 'info', title: t('reason.recording') });
    return true;
  }
  if (!sessions.some((session) => session.runtimeId === runtimeId && session.past !== null)) return false;
  notify({ tone: 'info', title: t('reason.past') });
  return true;
}
