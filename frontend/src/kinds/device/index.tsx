import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import type en from './en.json';
import { onDemand } from '@/ui/onDemand';

declare module '@/i18n' {
  interface TextTables {
    device: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'device',
  icon: icon(
    'device',
    <>
      <rect x="1.75" y="3.25" width="12.5" height="9.5" rx="1.5" />
      <path d="M5.5 3.25v9.5M8 6h3.75M8 8.5h3.75" />
      <path d="M3.6 6h.05" strokeWidth={2} />
    </>,
  ),
  editor: onDemand(() => import('./DeviceEditor')),
  role: 'device',
  tree: { openAtFirst: true },
  add: { bringsChildren: true },
};

export default descriptor;
