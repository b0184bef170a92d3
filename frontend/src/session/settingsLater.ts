/** Personal settings that change often: stored a moment after the last change, at the latest when the page goes. */
import { saveSetting } from './preferences';

interface Waiting {
  timer: ReturnType<typeof setTimeout>;
  value: () => unknown;
  failed: (error: unknown) => void;
}

const waiting = new Map<string, Waiting>();

function store(key: string, keepalive: boolean): void {
  const entry = waiting.get(key);
  if (!entry) return;
  clearTimeout(entry.timer);
  waiting.delete(key);
  saveSetting(key, entry.value(), keepalive).catch(entry.failed);
}

/** Stores what `value` gives when nothing has changed for `after` milliseconds. */
export function saveSettingLater(
  key: string,
  value: () => unknown,
  after: number,
  failed: (error: unknown) => void = () => undefined,
): void {
  clearTimeout(waiting.get(key)?.timer);
  waiting.set(key, { timer: setTimeout(() => store(key, false), after), value, failed });
}

/** Stores now what still waits, before it is replaced or gone. */
export function saveSettingNow(key: string): void {
  store(key, false);
}

/** The browser cancels other requests of a page that goes. */
export function saveSettingsWhenThePageGoes(): void {
  addEventListener('pagehide', () => [...waiting.keys()].forEach((key) => store(key, true)));
}
