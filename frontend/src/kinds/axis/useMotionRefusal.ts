import { useText } from '@/i18n';
import type { OnlineSession } from '@/workbench/onlineSession';
import { atLeast } from '@/workbench/rights';
import { useCommandContext } from '@/workbench/useCommandContext';

/** Why nothing of a session can be moved from a page, in the words of the user; null: it can. */
export function useMotionRefusal(session: OnlineSession): string | null {
  const t = useText();
  const { role } = useCommandContext();
  if (!atLeast(role, 'operator')) return t('axis.needsOperator');
  if (session.lostSince !== null) return t('axis.noConnection');
  if (session.past !== null) return t('reason.past');
  return session.runtime?.state === 'run' ? null : t('axis.notRunning');
}
