import { lazy } from 'react';
import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    persistent: typeof en;
  }
}

const Persistent = icon(
  'variables',
  <>
    <ellipse cx="8" cy="4" rx="5.25" ry="2" />
    <path d="M2.75 4v8c0 1.1 2.35 2 5.25 2s5.25-.9 5.25-2V4M2.75 8c0 1.1 2.35 2 5.25 2s5.25-.9 5.25-2" />
  </>,
);

const descriptor: ObjectKindDescriptor = {
  kind: 'persistent',
  icon: Persistent,
  editor: lazy(() => import('@/editors/textObject/TextObjectEditor')),
  parts: ['declaration'],
  compiled: true,
  online: { valuesOf: () => 'global' },
  countedAs: () => 'lists',
};

export default descriptor;
