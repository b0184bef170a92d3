import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import { onDemand } from '@/ui/onDemand';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    cam: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'cam',
  icon: icon(
    'task',
    <>
      <path d="M2.5 2.25v11.25h11.25" />
      <path d="M4.5 11.25c4.5 0 2.75-7 8.5-7" />
    </>,
  ),
  compiled: true,
  editor: onDemand(() => import('./CamEditor')),
  online: { valuesOf: () => 'global' },
};

export default descriptor;
