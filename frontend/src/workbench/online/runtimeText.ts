import type { RuntimeException, RuntimeState } from '@/api/types';
import type { t as text } from '@/i18n';
import type { OnlineTone } from '../onlineSession';

export function toneOfRuntime(runtime: RuntimeState): OnlineTone {
  if (!runtime.connected) return 'lost';
  if (runtime.halted.length > 0) return 'halted';
  switch (runtime.state) {
    case 'run':
      return 'running';
    case 'exception':
      return 'exception';
    case 'stop':
      return 'stopped';
    default:
      return 'unknown';
  }
}

/** State of a runtime in words. */
export function runtimeText(runtime: RuntimeState, t: typeof text): string {
  if (runtime.connected && runtime.halted.length > 0)
    return t('runtime.state.halted', { tasks: runtime.halted.join(', ') });
  return t(runtime.connected ? `runtime.state.${runtime.state ?? 'empty'}` : 'runtime.state.notConnected');
}

/** The application has ended the process of the controller: it is loaded again, and waits to be started. */
export const waitsForStart = (exception: RuntimeException | null | undefined): boolean =>
  exception?.name === 'PROCESS_ENDED';
