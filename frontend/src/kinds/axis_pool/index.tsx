import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import { onDemand } from '@/ui/onDemand';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    axis_pool: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'axis_pool',
  icon: icon(
    'task',
    <>
      <circle cx="6" cy="6" r="3.75" />
      <path d="M6 6h7.5M6 6v7.5M11.5 4 13.5 6l-2 2M4 11.5l2 2 2-2" />
    </>,
  ),
  compiled: true,
  editor: onDemand(() => import('./AxisPoolEditor')),
  tree: { openAtFirst: true, fixedName: 'SoftMotion General Axis Pool', outsidePaths: true },
};

export default descriptor;
