/**
 * Every room registers its editors, panels and commands in a `register.ts` of its own; all of them are found here.
 * A `register.ts` only registers: the components behind it are loaded when they are first shown.
 */
import { registerWorkbench, registerPanelCommands } from '@/workbench/register';

export function registerRooms(): void {
  registerWorkbench();
  import.meta.glob(['../{editors,online,lsp}/**/register.ts', '../workbench/tests/register.ts'], { eager: true });
  registerPanelCommands();
}
