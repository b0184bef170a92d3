/** Commands of recipe definitions; there only while one is what commands act on. */
import { activeHandler, useRegistry, type Command } from '@/workbench/commands';
import { RECIPE_ACTS } from './acts';

export const commands: readonly Command[] = RECIPE_ACTS.map(({ id }, order) => ({
  id,
  title: id,
  delegated: true,
  visible: (context) => activeHandler(id, context, useRegistry.getState().handlers) !== undefined,
  menu: { menu: 'edit', group: '8_recipes', order, submenu: 'recipes.menu' },
}));
