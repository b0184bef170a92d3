/** Commands of CNC programs (CNC-80 to CNC-92); there only while one is what commands act on. */
import { activeHandler, useRegistry, type Command } from '@/workbench/commands';
import { CNC_ACTS } from './acts';

export const commands: readonly Command[] = CNC_ACTS.map(({ id }, order) => ({
  id,
  title: id,
  delegated: true,
  visible: (context) => activeHandler(id, context, useRegistry.getState().handlers) !== undefined,
  menu: { menu: 'edit', group: '8_cnc', order, submenu: 'cnc.menu' },
}));
