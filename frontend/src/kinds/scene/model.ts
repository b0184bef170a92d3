import { LOCAL_RUNTIME } from '@/workbench/online/offlineTarget';
import type { OnlineSession } from '@/workbench/onlineSession';

/** The runtime whose values move the scene: the one logged in to, else the server's own. */
export function runtimeOf(sessions: readonly OnlineSession[]): string {
  return sessions[0]?.runtimeId ?? LOCAL_RUNTIME;
}

/** The past cycle of that runtime that all views show; null: the present. */
export function pastCycleOf(sessions: readonly OnlineSession[]): number | null {
  return sessions[0]?.past?.cycle ?? null;
}
