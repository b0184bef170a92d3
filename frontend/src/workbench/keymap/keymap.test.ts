import { describe, expect, it } from 'vitest';
import { registerBookmarkCommands } from '@/bookmarks/register';
import { registerEditCommands } from '../commands/edit';
import { registerHelpCommands } from '../commands/help';
import { registerOnlineCommands } from '../commands/online';
import { registerProjectCommands } from '../commands/project';
import { registerToolsCommands } from '../commands/tools';
import { registerViewCommands } from '../commands/view';
import { registerWindowCommands } from '../commands/window';
import { findCommand, registerCommand, setKeysOf, useRegistry, type Command } from '../commands';
import { keyOfEvent } from '../keys';
import { conflicts, keymapOfFile, keysOf, soundKeymap, type Keymap } from './keymap';
import { PRESET_KEYS, PRESETS } from './presets';

const command = (id: string, keys?: string[], scope?: Command['scope']): Command => ({
  id,
  title: 'command.save',
  keys,
  scope,
});

describe('a keymap', () => {
  const keymap: Keymap = { preset: 'vscode', own: { 'a.b': ['Ctrl+1'], 'build.nextMessage': [] } };

  it('has keys of the user before those of the preset before those declared', () => {
    expect(keysOf(command('a.b', ['F1']), keymap)).toEqual(['Ctrl+1']);
    expect(keysOf(command('build.nextMessage', ['F4']), keymap)).toEqual([]);
    expect(keysOf(command('build.build', ['F11']), keymap)).toEqual(['Ctrl+Shift+B']);
    expect(keysOf(command('x.y', ['F1']), keymap)).toEqual(['F1']);
  });

  it('changes the keys of commands that are registered, and of later ones', () => {
    registerCommand(command('a.b', ['F1']));
    setKeysOf((one) => keysOf(one, keymap));
    registerCommand(command('build.build', ['F11']));
    expect(findCommand('a.b')?.keys).toEqual(['Ctrl+1']);
    expect(findCommand('build.build')?.keys).toEqual(['Ctrl+Shift+B']);
    setKeysOf((one) => one.keys);
    expect(findCommand('a.b')?.keys).toEqual(['F1']);
  });

  it('is read from a file, and other files are refused', () => {
    expect(keymapOfFile(JSON.stringify(keymap))).toEqual(keymap);
    for (const text of ['{}', '[]', '{"preset":"emacs","own":{}}', 'x']) expect(() => keymapOfFile(text)).toThrow();
    expect(soundKeymap({ preset: 'twincat', own: { a: 'F1', b: ['F1'], c: [1] } })).toEqual({
      preset: 'twincat',
      own: { b: ['F1'] },
    });
  });

  it('tells who has a combination already', () => {
    const all = [command('a', ['Ctrl+1']), command('b', ['Ctrl+1'], 'tree'), command('c', ['ctrl+1'], 'editor')];
    expect(conflicts(all, command('x'), 'Ctrl+1').map(({ id }) => id)).toEqual(['a']);
    expect(conflicts(all, command('x', [], 'editor'), 'Ctrl+1').map(({ id }) => id)).toEqual(['c']);
    expect(conflicts(all, command('x', [], 'text'), 'Ctrl+1').map(({ id }) => id)).toEqual(['c']);
    expect(conflicts(all, all[0]!, 'Ctrl+1')).toEqual([]);
  });

  it('writes down what was pressed', () => {
    const press = (key: string, ...modifiers: string[]) => ({
      key,
      ctrlKey: modifiers.includes('ctrl'),
      metaKey: false,
      shiftKey: modifiers.includes('shift'),
      altKey: modifiers.includes('alt'),
    });
    expect(keyOfEvent(press('k', 'ctrl', 'alt'))).toBe('Ctrl+Alt+K');
    expect(keyOfEvent(press('F8', 'shift'))).toBe('Shift+F8');
    expect(keyOfEvent(press(' ', 'ctrl'))).toBe('Ctrl+Space');
    expect(keyOfEvent(press('+', 'ctrl'))).toBe('Ctrl+Plus');
    expect(keyOfEvent(press('ArrowDown', 'alt'))).toBe('Alt+ArrowDown');
    expect(keyOfEvent(press('Control', 'ctrl'))).toBeNull();
    expect(keyOfEvent(press('a'))).toBeNull();
    expect(keyOfEvent(press('A', 'shift'))).toBeNull();
  });
});

describe('presets', () => {
  registerBookmarkCommands();
  registerEditCommands();
  registerHelpCommands();
  registerOnlineCommands();
  registerProjectCommands();
  registerToolsCommands();
  registerViewCommands();
  registerWindowCommands();
  const declared = [...useRegistry.getState().commands.values()];

  it.each(PRESETS)('%s gives no combination to two commands', (preset) => {
    const keyed = declared.map((one) => ({ ...one, keys: keysOf(one, { preset, own: {} }) }));
    const doubles = keyed.flatMap((one) =>
      (one.keys ?? []).flatMap((keys) => conflicts(keyed, one, keys).map((other) => `${keys}: ${one.id}, ${other.id}`)),
    );
    expect(doubles).toEqual([]);
  });

  it.each(PRESETS)('%s names commands of the workbench that exist', (preset) => {
    const rooms = ['bookmarks', 'edit', 'build', 'online', 'debug', 'project', 'file', 'window', 'tools'];
    const named = Object.keys(PRESET_KEYS[preset]).filter((id) => rooms.includes(id.split('.')[0]!));
    expect(named.filter((id) => findCommand(id) === undefined)).toEqual([]);
  });
});
