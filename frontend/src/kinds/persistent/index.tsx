import { textKind } from '@/editors/textObject/textKind';
import { icon } from '@/icons/shape';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    persistent: typeof en;
  }
}

export default textKind({
  kind: 'persistent',
  icon: icon(
    'variables',
    <>
      <ellipse cx="8" cy="4" rx="5.25" ry="2" />
      <path d="M2.75 4v8c0 1.1 2.35 2 5.25 2s5.25-.9 5.25-2V4M2.75 8c0 1.1 2.35 2 5.25 2s5.25-.9 5.25-2" />
    </>,
  ),
  parts: ['declaration'],
  online: { valuesOf: () => 'global' },
  countedAs: () => 'lists',
});
