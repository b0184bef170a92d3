import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import { onDemand } from '@/ui/onDemand';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    recipe_definition: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'recipe_definition',
  icon: icon(
    'variables',
    <>
      <rect x="2.25" y="2.75" width="11.5" height="10.5" rx="1" />
      <path d="M2.25 6h11.5M6.25 6v7.25M10 6v7.25M2.25 9.5h11.5" />
    </>,
  ),
  compiled: true,
  editor: onDemand(() => import('./RecipeEditor')),
};

export default descriptor;
