import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import type en from './en.json';
import { onDemand } from '@/ui/onDemand';

declare module '@/i18n' {
  interface TextTables {
    task_configuration: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'task_configuration',
  icon: icon(
    'task',
    <>
      <path d="M2.25 3.25h6M2.25 7h3.5M2.25 10.75h2.5" />
      <circle cx="10.5" cy="10" r="3.9" />
      <path d="M10.5 7.9V10l1.4.9" />
    </>,
  ),
  editor: onDemand(() => import('./TaskConfigurationEditor')),
  tree: { openAtFirst: true, fixedName: 'Task Configuration' },
};

export default descriptor;
