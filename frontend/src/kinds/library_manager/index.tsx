import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import type en from './en.json';
import { onDemand } from '@/ui/onDemand';

declare module '@/i18n' {
  interface TextTables {
    library_manager: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'library_manager',
  icon: icon(
    'folder',
    <>
      <path d="M2.5 2.75v10.5M5.5 2.75v10.5M2.5 13.25h3" />
      <path d="m8.2 3.6 3.9 9.7 1.9-.8-3.9-9.7z" />
    </>,
  ),
  editor: onDemand(() => import('./LibraryManagerEditor')),
  settings: [{ title: 'libraryParameters.title', component: onDemand(() => import('./ParametersPage')) }],
  role: 'libraries',
  tree: { fixedName: 'Library Manager' },
};

export default descriptor;
