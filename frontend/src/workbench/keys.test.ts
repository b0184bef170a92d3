import { describe, expect, it } from 'vitest';
import type { Command } from './commands';
import { belongsToField, findByKey, keysText, pressed, shieldedFromBrowser, type KeyPress } from './keys';

const press = (text: string): KeyPress => {
  const parts = text.split('+');
  return {
    key: parts.at(-1)!,
    ctrlKey: parts.includes('Ctrl'),
    metaKey: parts.includes('Meta'),
    shiftKey: parts.includes('Shift'),
    altKey: parts.includes('Alt'),
  };
};
const command = (id: string, keys: string[], scope?: Command['scope']): Command => ({
  id,
  title: 'command.save',
  keys,
  scope,
});

describe('keys', () => {
  it('match with all their modifiers and no others', () => {
    expect(pressed('Alt+F8', press('Alt+F8'))).toBe(true);
    expect(pressed('F8', press('Alt+F8'))).toBe(false);
    expect(pressed('Ctrl+Shift+P', press('Ctrl+Shift+P'))).toBe(true);
    expect(pressed('Del', press('Delete'))).toBe(true);
    expect(pressed('Ctrl+,', press('Ctrl+,'))).toBe(true);
  });

  it('take Command of a Mac for Ctrl', () => {
    expect(pressed('Ctrl+S', press('Meta+s'))).toBe(true);
  });

  it('are left to others by a command that is not shown', () => {
    const commands = [command('comment', ['Ctrl+O'], 'editor'), command('open', ['Ctrl+O'])];
    const shown = ({ id }: Command) => id !== 'comment';
    expect(findByKey(commands, press('Ctrl+O'), 'editor')?.id).toBe('comment');
    expect(findByKey(commands, press('Ctrl+O'), 'editor', shown)?.id).toBe('open');
  });

  it('find the command of the view first, then the one that acts everywhere', () => {
    const commands = [
      command('rename', ['F2'], 'tree'),
      command('assistant', ['F2'], 'editor'),
      command('build', ['F11']),
    ];
    expect(findByKey(commands, press('F2'), 'tree')?.id).toBe('rename');
    expect(findByKey(commands, press('F2'), 'editor')?.id).toBe('assistant');
    expect(findByKey(commands, press('F2'), 'text')?.id).toBe('assistant');
    expect(findByKey(commands, press('F2'), undefined)).toBeUndefined();
    expect(findByKey(commands, press('F11'), 'tree')?.id).toBe('build');
  });

  it('leave typing, the clipboard and undo to fields, function keys not', () => {
    expect(['a', 'Delete', 'ArrowLeft', 'Ctrl+c', 'Ctrl+z', 'Shift+A'].map(press).every(belongsToField)).toBe(true);
    expect(['F5', 'Alt+F8', 'Ctrl+s', 'Ctrl+Shift+P', 'Ctrl+F7'].map(press).some(belongsToField)).toBe(false);
  });

  it('never let F5 reload the page or Ctrl+P print it', () => {
    expect(['F5', 'F11', 'Shift+F8', 'Ctrl+p', 'Ctrl+s'].map(press).every(shieldedFromBrowser)).toBe(true);
    expect(
      ['F12', 'Shift+F10', 'Ctrl+Shift+i', 'Ctrl+r', 'a', 'Ctrl+c', 'Ctrl+t'].map(press).some(shieldedFromBrowser),
    ).toBe(false);
  });

  it('are shown as the machine writes them', () => {
    expect(keysText('Ctrl+Shift+P', false)).toBe('Ctrl+Shift+P');
    expect(keysText('Ctrl+Shift+P', true)).toBe('⌘⇧P');
    expect(keysText('Del', false)).toBe('Del');
    expect(keysText('Alt+Insert', false)).toBe('Alt+Insert');
  });
});
