import type { RuntimeState } from '@/api/types';
import type { t as text } from '@/i18n';
import type { OnlineTone } from '../onlineSession';

export function toneOfRuntime(runtime: RuntimeState): OnlineTone {
  if (!runtime.connected) return 'lost';
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
  return t(runtime.connected ? `runtime.state.${runtime.state ?? 'empty'}` : 'runtime.state.notConnected');
}
