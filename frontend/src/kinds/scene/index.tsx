import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import type en from './en.json';
import { onDemand } from '@/ui/onDemand';

declare module '@/i18n' {
  interface TextTables {
    scene: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'scene',
  icon: icon(
    'scene',
    <>
      <path d="M8 1.9l5.4 3v6.2L8 14.1l-5.4-3V4.9z" />
      <path d="M2.6 4.9L8 8l5.4-3.1M8 8v6.1" />
    </>,
  ),
  editor: onDemand(() => import('./SceneEditor')),
};

export default descriptor;
