import { textKind } from '@/editors/textObject/textKind';
import { icon } from '@/icons/shape';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    interface: typeof en;
  }
}

export default textKind({
  kind: 'interface',
  icon: icon(
    'block',
    <>
      <circle cx="11" cy="8" r="2.75" />
      <path d="M2 8h6.25M2 5.25v5.5" />
    </>,
  ),
  parts: ['declaration'],
  add: {
    optionsOf: () => ['extends'],
    declarationOf: ({ name, values: { extends: base } }) => (base ? `INTERFACE ${name} EXTENDS ${base}` : null),
  },
  catalog: 'types',
});
