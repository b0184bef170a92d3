import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import { onDemand } from '@/ui/onDemand';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    axis_group: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'axis_group',
  icon: icon(
    'task',
    <>
      <path d="M2.5 13.5v-11M2.5 13.5h11M2.5 13.5 6 10" />
      <path d="M5 7.5C7 3.5 9.5 9.5 13 4.5" />
    </>,
  ),
  compiled: true,
  editor: onDemand(() => import('./AxisGroupEditor')),
  online: { valuesOf: () => 'global' },
};

export default descriptor;
