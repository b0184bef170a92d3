/** The folders of the kinds, found by their place: a new kind is a new folder beside this file. */
import { registerKind, type ObjectKindDescriptor } from '@/project/kinds';
import { registerCommands, type Command } from '@/workbench/commands';

const DESCRIPTORS = import.meta.glob<ObjectKindDescriptor>('./*/index.tsx', { eager: true, import: 'default' });
/** What the editor of a kind does, for menus and the palette. */
const COMMANDS = import.meta.glob<readonly Command[]>('./*/commands.ts', { eager: true, import: 'commands' });

export function registerKinds(descriptors: Readonly<Record<string, ObjectKindDescriptor>> = DESCRIPTORS): void {
  Object.values(descriptors).forEach(registerKind);
  if (descriptors === DESCRIPTORS) Object.values(COMMANDS).forEach(registerCommands);
}
