/** The keys of the user: a preset, and commands with keys of their own. Kept on the server for the account. */
import { settingsOf } from '@/session/settings';
import { setKeysOf, type Command } from '../commands';
import { sameKeys } from '../keys';
import { PRESET_KEYS, PRESETS, type KeyTable, type Preset } from './presets';

export interface Keymap {
  preset: Preset;
  own: KeyTable;
}

const settings = settingsOf<Keymap>('keys', { preset: 'tappet', own: {} });

export const useKeymap = settings.use;

/** From now on commands have the keys of the user. Answers the act that ends it. */
export function startKeymap(): () => void {
  const stop = settings.use.subscribe(apply);
  apply();
  void settings.load();
  return stop;
}

function apply(): void {
  const keymap = soundKeymap(settings.use.getState());
  setKeysOf((command) => keysOf(command, keymap));
}

/** The keys of a command as it was declared: its own, else those of the preset, else those of its declaration. */
export function keysOf(command: Pick<Command, 'id' | 'keys'>, { preset, own }: Keymap): readonly string[] | undefined {
  return own[command.id] ?? PRESET_KEYS[preset][command.id] ?? command.keys;
}

export function choosePreset(preset: Preset): void {
  settings.change({ preset });
}

export function giveKeys(id: string, keys: readonly string[]): void {
  settings.change({ own: { ...soundKeymap(settings.use.getState()).own, [id]: keys } });
}

/** The command has the keys of the preset again. */
export function resetKeys(id: string): void {
  const { [id]: _, ...own } = soundKeymap(settings.use.getState()).own;
  settings.change({ own });
}

export function replaceKeymap(keymap: Keymap): void {
  settings.change(keymap);
}

/** What was stored or imported, without what is no keymap. */
export function soundKeymap(value: unknown): Keymap {
  const { preset, own } = (typeof value === 'object' && value !== null ? value : {}) as Partial<
    Record<string, unknown>
  >;
  const entries = typeof own === 'object' && own !== null ? Object.entries(own) : [];
  const sound = entries.filter(
    (entry): entry is [string, string[]] =>
      Array.isArray(entry[1]) && entry[1].every((keys: unknown) => typeof keys === 'string' && keys !== ''),
  );
  return { preset: PRESETS.find((one) => one === preset) ?? 'tappet', own: Object.fromEntries(sound) };
}

/** Reads a file of keys; throws when it is none. */
export function keymapOfFile(text: string): Keymap {
  const value: unknown = JSON.parse(text);
  const known = typeof value === 'object' && value !== null && 'preset' in value && 'own' in value;
  if (!known || !PRESETS.some((preset) => preset === value.preset)) throw new Error('no keymap');
  return soundKeymap(value);
}

/** Other commands that a combination would reach where the command is reached by it. */
export function conflicts(commands: Iterable<Command>, command: Command, keys: string): Command[] {
  return [...commands].filter(
    (other) =>
      other.id !== command.id &&
      // Keys of a view come before those of everywhere: that is no conflict but what is meant.
      viewOf(other) === viewOf(command) &&
      (other.keys ?? []).some((one) => sameKeys(one, keys)),
  );
}

/** Texts are in editors: a command of the one would take the keys of a command of the other. */
function viewOf({ scope }: Command): Command['scope'] {
  return scope === 'text' ? 'editor' : scope;
}
