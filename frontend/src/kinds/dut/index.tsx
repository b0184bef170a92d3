import { textKind } from '@/editors/textObject/textKind';
import { icon, BOX } from '@/icons/shape';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    dut: typeof en;
  }
}

const Struct = icon(
  'data',
  <>
    {BOX}
    <path d="M2.25 6.1h11.5M2.25 9.9h11.5M6.4 6.1v7.65" />
  </>,
);

const Enumeration = icon(
  'data',
  <>
    <path d="M6.75 4h7M6.75 8h7M6.75 12h7" />
    <path d="M2.4 4h1.2M2.4 8h1.2M2.4 12h1.2" strokeWidth={2.2} />
  </>,
);

const Union = icon(
  'data',
  <>
    <rect x="2.25" y="2.25" width="7.75" height="7.75" rx="1.5" />
    <path d="M6 12.25v.25c0 .7.55 1.25 1.25 1.25h5.25c.7 0 1.25-.55 1.25-1.25V7.25C13.75 6.55 13.2 6 12.5 6h-.25" />
  </>,
);

const Alias = icon('data', <path d="M2.25 5.75h11.5M2.25 10.25h8M11 7.5l2.75 2.75L11 13" />);

export default textKind({
  kind: 'dut',
  icon: Struct,
  subkinds: {
    struct: { icon: Struct, short: 'STRUCT' },
    enum: { icon: Enumeration, short: 'ENUM' },
    union: { icon: Union, short: 'UNION' },
    alias: { icon: Alias, short: 'ALIAS' },
    subrange: { short: 'SUBRANGE' },
    // Libraries call so what is none of these.
    type: {},
  },
  parts: ['declaration'],
  add: {
    optionsOf: (subkind) => {
      if (subkind === 'struct') return ['extends'];
      return subkind === 'alias' ? ['base'] : [];
    },
    declarationOf: ({ subkind, name, values: { extends: parent, base } }) => {
      if (subkind === 'struct' && parent) return `TYPE ${name} EXTENDS ${parent} :\nSTRUCT\nEND_STRUCT\nEND_TYPE`;
      return subkind === 'alias' && base ? `TYPE ${name} : ${base};\nEND_TYPE` : null;
    },
  },
  catalog: 'types',
  countedAs: () => 'types',
});
