import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import { onDemand } from '@/ui/onDemand';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    script: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'script',
  icon: icon(
    'task',
    <>
      <path d="M3.25 1.9h5.9l3.6 3.6v8.6h-9.5z" />
      <path d="m6.6 7.6-1.7 1.9 1.7 1.9M9.4 7.6l1.7 1.9-1.7 1.9" />
    </>,
  ),
  editor: onDemand(() => import('./ScriptEditor')),
  role: 'script',
};

export default descriptor;
