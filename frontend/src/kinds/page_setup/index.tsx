import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import { onDemand } from '@/ui/onDemand';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    page_setup: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'page_setup',
  icon: icon(
    'member',
    <>
      <rect x="3.25" y="1.9" width="9.5" height="12.2" rx="1" />
      <path d="M3.5 4.75h9M3.5 11.25h9" />
    </>,
  ),
  editor: onDemand(() => import('./PageSetupEditor')),
  usual: onDemand(() => import('./UsualPageSetup')),
  role: 'page-setup',
  tree: { fixedName: 'Page Setup' },
};

export default descriptor;
