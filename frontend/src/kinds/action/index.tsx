import { lazy } from 'react';
import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    action: typeof en;
  }
}

const Action = icon('member', <path d="M8.9 1.9 3.6 9h3.9l-.6 5.1L12.3 7H8.3z" />);

const descriptor: ObjectKindDescriptor = {
  kind: 'action',
  icon: Action,
  editor: lazy(() => import('@/editors/textObject/TextObjectEditor')),
  // An action has no variables of its own; its first line is its name.
  parts: ['implementation'],
  compiled: true,
  online: { valuesOf: () => 'owner' },
};

export default descriptor;
