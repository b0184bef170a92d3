/** Keys: parse `Ctrl+Shift+P`, compare with an event, find the command, write for the reader. Pure functions. */
import type { Command } from './commands';

interface Stroke {
  ctrl: boolean;
  shift: boolean;
  alt: boolean;
  key: string;
}

const NAMES: Record<string, string> = { del: 'delete', esc: 'escape', space: ' ', plus: '+', return: 'enter' };

function parseKeys(text: string): Stroke {
  const parts = text.split('+').map((part) => part.trim().toLowerCase());
  const last = parts.pop() ?? '';
  return {
    ctrl: parts.includes('ctrl'),
    shift: parts.includes('shift'),
    alt: parts.includes('alt'),
    key: NAMES[last] ?? last,
  };
}

/** Whether two combinations are one, however they are written. */
export function sameKeys(one: string, other: string): boolean {
  const [a, b] = [parseKeys(one), parseKeys(other)];
  return a.key === b.key && a.ctrl === b.ctrl && a.shift === b.shift && a.alt === b.alt;
}

const WRITTEN: Record<string, string> = { ' ': 'Space', '+': 'Plus', Delete: 'Del', Escape: 'Esc' };
const MODIFIER_KEYS = ['Control', 'Shift', 'Alt', 'Meta', 'AltGraph', 'Dead', 'Process', 'Unidentified'];

/** The combination that was pressed; null while it is none, or one that types a character. */
export function keyOfEvent(event: KeyPress): string | null {
  const { key } = event;
  if (MODIFIER_KEYS.includes(key)) return null;
  const ctrl = event.ctrlKey || event.metaKey;
  if (key.length === 1 && !ctrl && !event.altKey) return null;
  const name = WRITTEN[key] ?? (key.length === 1 ? key.toUpperCase() : key);
  return [ctrl && 'Ctrl', event.shiftKey && 'Shift', event.altKey && 'Alt', name].filter(Boolean).join('+');
}

export interface KeyPress {
  key: string;
  ctrlKey: boolean;
  metaKey: boolean;
  shiftKey: boolean;
  altKey: boolean;
}

/** Command on a Mac counts as Ctrl. */
export function pressed(text: string, event: KeyPress): boolean {
  const stroke = parseKeys(text);
  return (
    event.key.toLowerCase() === stroke.key &&
    (event.ctrlKey || event.metaKey) === stroke.ctrl &&
    event.shiftKey === stroke.shift &&
    event.altKey === stroke.alt
  );
}

/** How near commands of a scope are to where a key was pressed; null for those of other views. */
function nearness(scope: Command['scope'], pressedIn: Command['scope']): number | null {
  if (scope === undefined) return 0;
  if (scope === pressedIn) return 2;
  return scope === 'editor' && pressedIn === 'text' ? 1 : null;
}

/** The command of a key: that of the view first; those that are not `shown` now leave it to others. */
export function findByKey(
  commands: Iterable<Command>,
  event: KeyPress,
  scope: Command['scope'],
  shown: (command: Command) => boolean = () => true,
): Command | undefined {
  let found: Command | undefined;
  let best = -1;
  for (const command of commands) {
    if (!command.keys?.some((keys) => pressed(keys, event)) || !shown(command)) continue;
    const near = nearness(command.scope, scope);
    if (near === null || near <= best) continue;
    found = command;
    best = near;
  }
  return found;
}

/** Where the browser's own meaning of a key comes first: typing, clipboard and undo inside plain fields. */
export function belongsToField(event: KeyPress): boolean {
  if (event.altKey) return false;
  const key = event.key.toLowerCase();
  if (!event.ctrlKey && !event.metaKey)
    return key.length === 1 || ['delete', 'backspace', 'enter', 'home', 'end'].includes(key) || key.startsWith('arrow');
  return ['c', 'x', 'v', 'a', 'z', 'y', 'insert', 'home', 'end'].includes(key) || key.startsWith('arrow');
}

/**
 * Keys whose meaning in the browser would take the user away from the work (reload, print, search bar, full screen ...)
 * and that must do nothing here even when their command is not possible now. F12 and Ctrl+Shift+I stay the browser's
 * while no editor uses them.
 */
export function shieldedFromBrowser(event: KeyPress): boolean {
  const key = event.key.toLowerCase();
  // Shift+F10 opens the context menu of what has the focus.
  if (key === 'f10' && event.shiftKey) return false;
  if (/^f([1-9]|1[01])$/.test(key)) return true;
  const ctrl = (event.ctrlKey || event.metaKey) && !event.altKey;
  return ctrl && !event.shiftKey && ['s', 'p', 'f', 'g', 'h', 'd', 'o', 'e', 'k', 'u'].includes(key);
}

const SHOWN: Record<string, string> = {
  delete: 'Del',
  escape: 'Esc',
  ' ': 'Space',
  arrowup: '↑',
  arrowdown: '↓',
  arrowleft: '←',
  arrowright: '→',
  enter: 'Enter',
  pageup: 'PageUp',
  pagedown: 'PageDown',
};

/** As menus show it; on a Mac with its symbols. */
export function keysText(text: string, mac = isMac()): string {
  const stroke = parseKeys(text);
  const key =
    SHOWN[stroke.key] ??
    (stroke.key.length === 1 ? stroke.key.toUpperCase() : stroke.key.charAt(0).toUpperCase() + stroke.key.slice(1));
  if (mac) return `${stroke.ctrl ? '⌘' : ''}${stroke.alt ? '⌥' : ''}${stroke.shift ? '⇧' : ''}${key}`;
  return [stroke.ctrl && 'Ctrl', stroke.alt && 'Alt', stroke.shift && 'Shift', key].filter(Boolean).join('+');
}

function isMac(): boolean {
  return typeof navigator !== 'undefined' && /Mac/.test(navigator.platform);
}
