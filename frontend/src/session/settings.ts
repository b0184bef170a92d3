/** What the user chose in one area of the workbench; kept on the server for the account, under a key of its own. */
import { create, type StoreApi, type UseBoundStore } from 'zustand';
import { loadSetting, saveSetting } from './preferences';

const SAVE_AFTER_MS = 1000;

export interface Settings<Values> {
  use: UseBoundStore<StoreApi<Values>>;
  /** Reads the settings once; until then, and when they cannot be read, the defaults hold. */
  load: () => Promise<void>;
  /** Takes effect at once and is stored a little later. */
  change: (change: Partial<Values>) => void;
}

export function settingsOf<Values extends object>(key: string, defaults: Values): Settings<Values> {
  const use = create<Values>(() => defaults);
  let loaded: Promise<void> | null = null;
  let timer: ReturnType<typeof setTimeout> | undefined;
  /** What was changed before it was loaded stays as it was changed. */
  let changed: Partial<Values> = {};

  const load = () => {
    loaded ??= loadSetting(key).then(
      (stored) => use.setState({ ...sound(defaults, stored), ...changed }),
      () => undefined,
    );
    return loaded;
  };
  const store = () => load().then(() => saveSetting(key, use.getState()));
  const change = (some: Partial<Values>) => {
    changed = { ...changed, ...some };
    use.setState(some);
    clearTimeout(timer);
    timer = setTimeout(() => void store().catch(() => undefined), SAVE_AFTER_MS);
  };
  return { use, load, change };
}

/** Keeps only what has the right type: settings may come from another version. */
function sound<Values extends object>(defaults: Values, stored: unknown): Partial<Values> {
  const values = new Map<string, unknown>(Object.entries(stored ?? {}));
  const right = Object.entries(defaults).filter(([key, value]) => typeof values.get(key) === typeof value);
  return Object.fromEntries(right.map(([key]) => [key, values.get(key)])) as Partial<Values>;
}
