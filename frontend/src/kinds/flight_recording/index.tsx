import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import { onDemand } from '@/ui/onDemand';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    flight_recording: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'flight_recording',
  icon: icon(
    'task',
    <>
      <path d="M3 8a5 5 0 1 0 1.6-3.7" />
      <path d="M2.9 2.6v2.6h2.6M8 5.2V8l1.9 1.4" />
    </>,
  ),
  editor: onDemand(() => import('./RecordingEditor')),
};

export default descriptor;
