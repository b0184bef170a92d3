import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import { onDemand } from '@/ui/onDemand';
import { RunningMark } from './RunningMark';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    trace: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'trace',
  icon: icon(
    'task',
    <>
      <path d="M2.5 2.25v11.25h11.25" />
      <path d="M4.5 9.5h1.75l1.5-5 2 7 1.5-4h2.25" />
    </>,
  ),
  editor: onDemand(() => import('./TraceEditor')),
  state: RunningMark,
};

export default descriptor;
