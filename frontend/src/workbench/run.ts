/** Running commands, from menus, buttons, keys and the palette alike. */
import { create } from 'zustand';
import { t, type TextKey } from '@/i18n';
import {
  activeHandler,
  enablementOf,
  findCommand,
  useRegistry,
  type Command,
  type MenuId,
  type Reason,
} from './commands';
import { commandContext, type CommandContext } from './context';
import { dialogOpen } from '@/ui/dialogs';
import { belongsToField, findByKey, shieldedFromBrowser } from './keys';
import { guard, notify } from '@/ui/notices';

export function titleOf(command: Command): string {
  return t(command.title, command.titleValues);
}

export function reasonText(reason: Reason): string {
  return typeof reason === 'string' ? t(reason) : t(reason.key, reason.values);
}

/** Null when the command may run now, else why not. */
export function refusal(command: Command, context: CommandContext): string | null {
  const enablement = enablementOf(command, context, useRegistry.getState().handlers);
  return enablement === true ? null : reasonText(enablement);
}

/** Runs the command if it may; a refusal or a failure becomes a notice, the refusal of a quiet command does not. */
export async function runCommand(id: string, argument?: unknown): Promise<void> {
  const command = findCommand(id);
  if (!command) return;
  const context = commandContext();
  const refused = refusal(command, context);
  if (refused !== null) {
    if (command.quiet) return;
    notify({ tone: 'info', title: t('notices.notNow', { command: titleOf(command) }), text: refused });
    return;
  }
  const handler = command.delegated ? activeHandler(id, context, useRegistry.getState().handlers) : undefined;
  await guard(async () => (handler ? handler.run(argument) : command.run?.(context, argument)));
}

function scopeOf(target: EventTarget | null): Command['scope'] {
  if (!(target instanceof Element)) return undefined;
  if (target.closest('[data-scope="tree"]')) return 'tree';
  if (target.closest('[data-scope="editor"]') === null) return undefined;
  // Fields of widgets within a text editor, like those of its search, are no text.
  return target.matches('.monaco-editor textarea.inputarea') ? 'text' : 'editor';
}

function isField(target: EventTarget | null): boolean {
  return target instanceof HTMLElement && (target.matches('input, textarea, select') || target.isContentEditable);
}

/** Monaco types into a hidden field; undo and the clipboard are the editor's own affair there, too. */
function onKeyDown(event: KeyboardEvent): void {
  if (dialogOpen()) {
    if (shieldedFromBrowser(event)) event.preventDefault();
    return;
  }
  if (isField(event.target) && belongsToField(event)) return;
  const { commands } = useRegistry.getState();
  const context = commandContext();
  const shown = (command: Command) =>
    (command.visible?.(context) ?? true) && !(command.yieldsKeys && refusal(command, context) !== null);
  const command = findByKey(commands.values(), event, scopeOf(event.target), shown);
  if (command) {
    event.preventDefault();
    event.stopPropagation();
    void runCommand(command.id);
  } else if (openMenuByLetter(event)) {
    event.preventDefault();
    event.stopPropagation();
  } else if (shieldedFromBrowser(event)) event.preventDefault();
}

/** Listens before any view does, so that F5 never reloads the page. Answers the act that ends it. */
export function listenToKeys(): () => void {
  window.addEventListener('keydown', onKeyDown, true);
  return () => window.removeEventListener('keydown', onKeyDown, true);
}

const MENU_IDS: readonly MenuId[] = [
  'file',
  'edit',
  'view',
  'project',
  'build',
  'online',
  'debug',
  'tools',
  'window',
  'help',
];

/** Alt and this letter open a menu; W closes an editor, so that Window has its second letter. */
const LETTERS: Record<MenuId, string> = {
  file: 'F',
  edit: 'E',
  view: 'V',
  project: 'P',
  build: 'B',
  online: 'O',
  debug: 'D',
  tools: 'T',
  window: 'I',
  help: 'H',
};

/** The menus of the menu bar, left to right. */
export const MENUS: readonly { id: MenuId; title: TextKey; letter: string }[] = MENU_IDS.map((id) => ({
  id,
  title: `menu.${id}`,
  letter: LETTERS[id],
}));

/** The menu that is open; empty when none is. */
export const useOpenMenu = create<{ id: MenuId | '' }>(() => ({ id: '' }));

/** Opens the menu of Alt and a letter; false for other keys. */
function openMenuByLetter(event: KeyboardEvent): boolean {
  if (!event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return false;
  const menu = MENUS.find(({ letter }) => event.code === `Key${letter}`);
  if (menu !== undefined) useOpenMenu.setState({ id: menu.id });
  return menu !== undefined;
}
