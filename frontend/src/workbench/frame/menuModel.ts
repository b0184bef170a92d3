/** Menus and the tool bar as data, made from the registered commands. Pure functions. */
import type { Command, MenuId, MenuPlace } from '../commands';
import type { CommandContext } from '../context';
import type { TextKey } from '@/i18n';

export type CommandMenu = readonly CommandMenuGroup[];

export interface CommandMenuGroup {
  group: string;
  entries: readonly (Command | CommandSubmenu)[];
}

export interface CommandSubmenu {
  submenu: TextKey;
  entries: readonly Command[];
}

/** Where a command stands in the menus. */
export function placesOf(command: Command): readonly MenuPlace[] {
  if (!command.menu) return [];
  return Array.isArray(command.menu) ? (command.menu as readonly MenuPlace[]) : [command.menu as MenuPlace];
}

/** The entries of one menu, in groups by name, in a group by order. A submenu stands where its first entry would. */
export function menuOf(commands: Iterable<Command>, menu: MenuId, context: CommandContext): CommandMenu {
  const placed: { place: MenuPlace; command: Command }[] = [];
  for (const command of commands) {
    if (command.visible && !command.visible(context)) continue;
    for (const place of placesOf(command)) if (place.menu === menu) placed.push({ place, command });
  }
  placed.sort((a, b) => a.place.group.localeCompare(b.place.group) || (a.place.order ?? 0) - (b.place.order ?? 0));
  const groups: { group: string; entries: (Command | { submenu: TextKey; entries: Command[] })[] }[] = [];
  for (const { place, command } of placed) {
    let group = groups.at(-1);
    if (group?.group !== place.group) groups.push((group = { group: place.group, entries: [] }));
    if (!place.submenu) {
      group.entries.push(command);
      continue;
    }
    const submenu = group.entries.find((entry) => 'submenu' in entry && entry.submenu === place.submenu);
    if (submenu && 'submenu' in submenu) submenu.entries.push(command);
    else group.entries.push({ submenu: place.submenu, entries: [command] });
  }
  return groups;
}

/** The buttons of the tool bar, in groups. */
export function toolbarOf(commands: Iterable<Command>, context: CommandContext): readonly (readonly Command[])[] {
  const shown = [...commands].filter((command) => command.toolbar && (command.visible?.(context) ?? true));
  shown.sort(
    (a, b) => a.toolbar!.group.localeCompare(b.toolbar!.group) || (a.toolbar!.order ?? 0) - (b.toolbar!.order ?? 0),
  );
  const groups: Command[][] = [];
  let last = '';
  for (const command of shown) {
    if (command.toolbar!.group !== last || groups.length === 0) groups.push([]);
    last = command.toolbar!.group;
    groups.at(-1)!.push(command);
  }
  return groups;
}
