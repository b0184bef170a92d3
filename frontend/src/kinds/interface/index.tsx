import { lazy } from 'react';
import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    interface: typeof en;
  }
}

const Interface = icon(
  'block',
  <>
    <circle cx="11" cy="8" r="2.75" />
    <path d="M2 8h6.25M2 5.25v5.5" />
  </>,
);

const descriptor: ObjectKindDescriptor = {
  kind: 'interface',
  icon: Interface,
  editor: lazy(() => import('@/editors/textObject/TextObjectEditor')),
  parts: ['declaration'],
  compiled: true,
  add: {
    optionsOf: () => ['extends'],
    declarationOf: ({ name, values: { extends: base } }) => (base ? `INTERFACE ${name} EXTENDS ${base}` : null),
  },
  catalog: 'types',
};

export default descriptor;
