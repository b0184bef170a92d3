import { textKind } from '@/editors/textObject/textKind';
import { icon } from '@/icons/shape';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    method: typeof en;
  }
}

export default textKind({
  kind: 'method',
  icon: icon(
    'member',
    <>
      <path d="M5.5 3.25H4.25a1.5 1.5 0 0 0-1.5 1.5v6.5a1.5 1.5 0 0 0 1.5 1.5H5.5M10.5 3.25h1.25a1.5 1.5 0 0 1 1.5 1.5v6.5a1.5 1.5 0 0 1-1.5 1.5H10.5" />
      <path d="M6 8h4M8.5 6.2 10.3 8 8.5 9.8" />
    </>,
  ),
  parts: ['declaration', 'implementation'],
  add: {
    optionsOf: () => ['returns', 'access'],
    declarationOf: ({ name, values: { returns, access } }) =>
      `METHOD ${access && access !== 'PUBLIC' ? `${access} ` : ''}${name}${returns ? ` : ${returns}` : ''}\nVAR_INPUT\nEND_VAR`,
  },
  online: { valuesOf: () => 'call' },
});
