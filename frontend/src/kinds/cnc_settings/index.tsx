import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import { onDemand } from '@/ui/onDemand';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    cnc_settings: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'cnc_settings',
  icon: icon(
    'task',
    <>
      <path d="M2.25 4.5h6M11.75 4.5h2M2.25 11.5h2M7.75 11.5h6" />
      <circle cx="10" cy="4.5" r="1.75" />
      <circle cx="6" cy="11.5" r="1.75" />
    </>,
  ),
  editor: onDemand(() => import('./CncSettingsEditor')),
  tree: { fixedName: 'CNC settings' },
};

export default descriptor;
