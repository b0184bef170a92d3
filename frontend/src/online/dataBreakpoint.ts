/** Data breakpoints from where a variable is shown. */
import { t } from '@/i18n';
import { newDataBreakpoint } from '@/workbench/debugger/BreakpointDialog';
import { connected, engineer, live, online, when } from '@/workbench/conditions';
import { commandContext } from '@/workbench/context';
import { reasonText } from '@/workbench/run';
import { notify } from '@/ui/notices';
import { channelOf } from './connections';

/** Bytes that the debugger compares before each statement, at most. */
const MOST_BYTES = 1024;

export const mayBreakOnChange = when(online, connected, engineer, live);

/** Null where a program can be halted when the value changes, else why not. */
export function whyNoDataBreakpoint(runtimeId: string | null, expression: string): string | null {
  const allowed = mayBreakOnChange(commandContext());
  if (allowed !== true) return reasonText(allowed);
  const item = channelOf(runtimeId)?.board.get(expression)?.item;
  if (item?.error) return item.error;
  if (item?.place == null) return t('debugger.reason.noVariable');
  if (item.flags?.includes('CONSTANT') === true) return t('online.constantFixed');
  if (item.size > MOST_BYTES) return t('debugger.reason.tooLarge', { size: item.size, most: MOST_BYTES });
  return null;
}

/** Asks what is to happen when a variable changes, or says why nothing can. */
export async function breakOnChange(runtimeId: string, expression: string): Promise<void> {
  const reason = whyNoDataBreakpoint(runtimeId, expression);
  if (reason === null) await newDataBreakpoint(runtimeId, expression);
  else notify({ tone: 'info', title: t('notices.notNow', { command: t('debugger.breakOnChange') }), text: reason });
}
