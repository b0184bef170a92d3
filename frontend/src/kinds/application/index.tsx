import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import { hasUsableHeap } from './heap';
import { hasUsableReserve } from './reserve';
import { hasUsablePrefixes } from './rules';
import type en from './en.json';
import { onDemand } from '@/ui/onDemand';

declare module '@/i18n' {
  interface TextTables {
    application: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'application',
  icon: icon(
    'program',
    <>
      <path d="m8 1.75 5.5 3.1v6.3L8 14.25l-5.5-3.1v-6.3z" />
      <path d="m2.7 5 5.3 3 5.3-3M8 8v6" />
    </>,
  ),
  editor: onDemand(() => import('./ApplicationEditor')),
  settings: [
    {
      title: 'application.memoryAndSource',
      component: onDemand(() => import('./SettingsPage')),
      canStore: (object) => hasUsableHeap(object) && hasUsableReserve(object),
    },
    { title: 'warnings.title', component: onDemand(() => import('./WarningsPage')) },
    { title: 'analysis.rules', component: onDemand(() => import('./RulesPage')), canStore: hasUsablePrefixes },
  ],
  role: 'application',
  tree: { openAtFirst: true },
  add: { bringsChildren: true },
};

export default descriptor;
