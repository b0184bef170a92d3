import { t } from '@/i18n';
import type { Command, MenuId } from '../commands';
import type { CommandContext } from '../context';
import { keysText } from '../keys';
import { refusal, runCommand, titleOf } from '../run';
import type { MenuEntry } from '@/ui/Menu';
import { menuOf } from './menuModel';

/** One command as a menu entry. */
function commandEntry(command: Command, context: CommandContext, argument?: unknown): MenuEntry {
  const keys = command.keys?.[0];
  return {
    kind: 'item',
    key: command.id,
    text: titleOf(command),
    icon: command.icon,
    shortcut: keys && keysText(keys),
    checked: command.checked?.(context),
    disabledReason: refusal(command, context),
    run: () => void runCommand(command.id, argument),
  };
}

/** A menu of the menu bar, its groups divided by lines. */
export function menuEntries(commands: Iterable<Command>, menu: MenuId, context: CommandContext): MenuEntry[] {
  return menuOf(commands, menu, context).flatMap((group, at): MenuEntry[] => [
    ...(at > 0 ? [{ kind: 'line', key: `line-${group.group}` } as const] : []),
    ...group.entries.map((entry): MenuEntry =>
      'submenu' in entry
        ? {
            kind: 'sub',
            key: entry.submenu,
            text: t(entry.submenu),
            entries: entry.entries.map((command) => commandEntry(command, context)),
          }
        : commandEntry(entry, context),
    ),
  ]);
}

/** Named commands as entries, for context menus; null draws a line, unknown or invisible ones are left out. */
export function entriesOf(
  ids: readonly (string | null)[],
  commands: ReadonlyMap<string, Command>,
  context: CommandContext,
  argument?: unknown,
): MenuEntry[] {
  const entries: MenuEntry[] = [];
  ids.forEach((id, at) => {
    if (id === null) {
      if (entries.length > 0 && entries.at(-1)?.kind !== 'line') entries.push({ kind: 'line', key: `line-${at}` });
      return;
    }
    const command = commands.get(id);
    if (command && (command.visible?.(context) ?? true)) entries.push(commandEntry(command, context, argument));
  });
  if (entries.at(-1)?.kind === 'line') entries.pop();
  return entries;
}
