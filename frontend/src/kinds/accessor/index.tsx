import { textKind } from '@/editors/textObject/textKind';
import { icon } from '@/icons/shape';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    accessor: typeof en;
  }
}

const Getter = icon('member', <path d="M3 2.75v10.5M6.25 8h7M10.5 5.2 13.3 8l-2.8 2.8" />);

const Setter = icon('member', <path d="M3 2.75v10.5M13.25 8h-7M9 5.2 6.2 8 9 10.8" />);

export default textKind({
  kind: 'accessor',
  icon: Getter,
  iconOf: (name) => (name.toUpperCase() === 'SET' ? Setter : Getter),
  parts: ['declaration', 'implementation'],
  online: { valuesOf: () => 'call' },
});
