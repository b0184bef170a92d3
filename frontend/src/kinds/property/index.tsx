import { textKind } from '@/editors/textObject/textKind';
import { icon } from '@/icons/shape';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    property: typeof en;
  }
}

export default textKind({
  kind: 'property',
  icon: icon(
    'member',
    <>
      <path d="M2.25 5h5M11 5h2.75M2.25 11H5M8.75 11h5" />
      <circle cx="9.1" cy="5" r="1.8" />
      <circle cx="6.9" cy="11" r="1.8" />
    </>,
  ),
  parts: ['declaration'],
  add: {
    bringsChildren: true,
    optionsOf: () => ['returns', 'access'],
    declarationOf: ({ name, values: { returns, access } }) => {
      const modifier = access && access !== 'PUBLIC' ? `${access} ` : '';
      return returns || modifier ? `PROPERTY ${modifier}${name} : ${returns ?? 'BOOL'}` : null;
    },
  },
  online: { valuesOf: () => 'call' },
});
