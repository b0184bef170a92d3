/** One channel for each runtime that an application is logged in to; they come and go with the logins. */
import { socketUrl } from '@/api/client';
import { onLanguageChange } from '@/i18n';
import {
  connectionLost,
  forcesReceived,
  runtimeStateReceived,
  useOnline,
  valuesPaced,
} from '@/workbench/onlineSession';
import { BROWSER_CLOCK, ValueBoard } from './board';
import { OnlineChannel } from './channel';

/** Who follows the past cycles that channels show. */
const listeners = { looked: (_runtimeId: string, _cycle: number | null, _problem: string | null): void => undefined };

export function onLooked(listener: typeof listeners.looked): void {
  listeners.looked = listener;
}

const channels = new Map<string, OnlineChannel>();

function openChannel(runtimeId: string): OnlineChannel {
  return new OnlineChannel(new ValueBoard(BROWSER_CLOCK), socketUrl('/online', { runtime: runtimeId }), {
    state: (state) => runtimeStateReceived(runtimeId, state),
    forces: (expressions, places) => forcesReceived(runtimeId, expressions, places),
    lost: () => connectionLost(runtimeId),
    looked: (cycle, problem) => listeners.looked(runtimeId, cycle, problem),
    paced: (intervalMs) => valuesPaced(runtimeId, intervalMs),
  });
}

/** The channel of a runtime, null while no application is logged in to it. */
export function channelOf(runtimeId: string | null): OnlineChannel | null {
  return runtimeId === null ? null : (channels.get(runtimeId) ?? null);
}

function follow(): void {
  const wanted = new Set(Object.values(useOnline.getState().sessions).map((session) => session.runtimeId));
  for (const runtimeId of wanted) if (!channels.has(runtimeId)) channels.set(runtimeId, openChannel(runtimeId));
  for (const [runtimeId, channel] of channels) {
    if (wanted.has(runtimeId)) continue;
    channels.delete(runtimeId);
    channel.close();
  }
}

/** Opens and closes channels with the logins, from now on. */
export function followSessions(): void {
  follow();
  useOnline.subscribe(follow);
  onLanguageChange(() => channels.forEach((channel) => channel.speak()));
}
