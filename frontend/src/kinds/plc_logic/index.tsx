import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    plc_logic: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'plc_logic',
  icon: icon(
    'device',
    <>
      <rect x="4.25" y="4.25" width="7.5" height="7.5" rx="1.25" />
      <path d="M6.25 1.75v2.5M9.75 1.75v2.5M6.25 11.75v2.5M9.75 11.75v2.5M1.75 6.25h2.5M1.75 9.75h2.5M11.75 6.25h2.5M11.75 9.75h2.5" />
    </>,
  ),
  tree: { openAtFirst: true, fixedName: 'PLC Logic', outsidePaths: true },
  add: { bringsChildren: true },
};

export default descriptor;
