import type { ObjectSummary } from '@/api/types';
import { t } from '@/i18n';
import { objectIcon, opensEditor } from '@/project/kinds';
import type { Command } from '../commands';
import type { CommandContext } from '../context';
import { openObject } from '../docking/dock';
import { keysText } from '../keys';
import { displayName } from '@/project/objectName';
import { refusal, runCommand, titleOf } from '../run';
import { placesOf } from '../frame/menuModel';
import { lineage, objectPath } from '@/project/tree';
import type { IconComponent } from '@/icons/IconComponent';

export interface PaletteItem {
  id: string;
  text: string;
  detail?: string;
  icon?: IconComponent;
  keys?: string;
  disabledReason?: string | null;
  /** The variable it stands for, as the runtime knows it: it can be dragged to a watch list. */
  variable?: string | null;
  run: () => void;
}

/** All commands with their keys; those that cannot run now come last and say why. */
export function commandItems(commands: Iterable<Command>, context: CommandContext): PaletteItem[] {
  const items = [...commands]
    .filter((command) => !command.hidden && (command.visible?.(context) ?? true))
    .map((command): PaletteItem => {
      const keys = command.keys?.[0];
      const place = placesOf(command)[0];
      return {
        id: command.id,
        text: titleOf(command),
        detail: place && t(`menu.${place.menu}`),
        icon: command.icon,
        keys: keys && keysText(keys),
        disabledReason: refusal(command, context),
        run: () => void runCommand(command.id),
      };
    });
  const possible = items.filter((item) => !item.disabledReason).sort((a, b) => a.text.localeCompare(b.text));
  return [...possible, ...items.filter((item) => item.disabledReason)];
}

/** Every object that has an editor or a meaning of its own, with the path to where it is. */
export function objectItems(objects: readonly ObjectSummary[]): PaletteItem[] {
  return objects
    .filter(opensEditor)
    .map((object) => {
      const owner = lineage(objects, object.id)[1];
      return {
        id: object.id,
        text: displayName(object),
        detail: owner ? objectPath(objects, owner.id) : t('panel.pous'),
        icon: objectIcon(object.kind, object.subkind, object.name),
        run: () => openObject(object.id, object.name),
      };
    })
    .sort((a, b) => a.text.localeCompare(b.text));
}
