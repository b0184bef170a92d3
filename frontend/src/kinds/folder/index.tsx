import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    folder: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'folder',
  icon: icon(
    'folder',
    <path d="M1.9 11.75v-7.5c0-.7.55-1.25 1.25-1.25h2.9l1.6 1.75h5.2c.7 0 1.25.55 1.25 1.25v5.75c0 .7-.55 1.25-1.25 1.25h-9.7c-.7 0-1.25-.55-1.25-1.25z" />,
  ),
  role: 'folder',
  tree: { outsidePaths: true },
};

export default descriptor;
