import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import { onDemand } from '@/ui/onDemand';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    axis: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'axis',
  icon: icon(
    'task',
    <>
      <path d="M2 12.75h12M4 12.5v-9M12 12.5v-9" />
      <path d="M5.75 6.75h4.5v3.5h-4.5zM2 6.75h1.5M12.5 6.75H14" />
    </>,
  ),
  compiled: true,
  editor: onDemand(() => import('./AxisEditor')),
  online: { valuesOf: () => 'global' },
};

export default descriptor;
