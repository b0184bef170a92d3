import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import { onDemand } from '@/ui/onDemand';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    recipe_manager: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'recipe_manager',
  icon: icon(
    'variables',
    <>
      <path d="M2.25 4.5h4l1.25 1.5h6.25v7.25H2.25z" />
      <path d="M4.5 8.5h7M4.5 10.75h4.5" />
    </>,
  ),
  compiled: true,
  editor: onDemand(() => import('./RecipeManagerEditor')),
  tree: { openAtFirst: true, outsidePaths: true },
};

export default descriptor;
