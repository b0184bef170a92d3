/** Everything that registers itself with the workbench, in the order of the rooms; components load when first shown. */
import { registerEditors } from '@/editors/register';
import { registerKinds } from '@/kinds/register';
import { registerOnline } from '@/online/register';
import { registerPanelCommands, registerWorkbench } from '@/workbench/register';

export function registerRooms(): void {
  registerWorkbench();
  registerOnline();
  registerEditors();
  registerKinds();
  registerPanelCommands();
}
