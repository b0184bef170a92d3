import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import type en from './en.json';
import { onDemand } from '@/ui/onDemand';

declare module '@/i18n' {
  interface TextTables {
    task: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'task',
  icon: icon(
    'task',
    <>
      <circle cx="8" cy="8" r="5.9" />
      <path d="M8 4.6V8l2.3 1.6" />
    </>,
  ),
  editor: onDemand(() => import('./TaskEditor')),
  countedAs: () => 'tasks',
};

export default descriptor;
