/** Commands of cams (CAM-80 to CAM-83); there only while a cam is what commands act on. */
import { activeHandler, useRegistry, type Command } from '@/workbench/commands';
import { CAM_ACTS } from './acts';

export const commands: readonly Command[] = CAM_ACTS.map(({ id }, order) => ({
  id,
  title: id,
  delegated: true,
  visible: (context) => activeHandler(id, context, useRegistry.getState().handlers) !== undefined,
  menu: { menu: 'edit', group: '8_cam', order, submenu: 'cam.menu' },
}));
