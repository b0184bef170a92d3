import { textKind } from '@/editors/textObject/textKind';
import { icon } from '@/icons/shape';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    action: typeof en;
  }
}

export default textKind({
  kind: 'action',
  icon: icon('member', <path d="M8.9 1.9 3.6 9h3.9l-.6 5.1L12.3 7H8.3z" />),
  // An action has no variables of its own; its first line is its name.
  parts: ['implementation'],
  online: { valuesOf: () => 'owner' },
});
