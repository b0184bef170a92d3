import { textKind } from '@/editors/textObject/textKind';
import { icon, BOX } from '@/icons/shape';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    pou: typeof en;
  }
}

const Program = icon(
  'program',
  <>
    {BOX}
    <path d="M6.5 5.4v5.2L10.6 8z" fill="currentColor" style={{ color: 'var(--kind-program)' }} />
  </>,
);

const FunctionBlock = icon(
  'block',
  <>
    <rect x="4.25" y="2.25" width="7.5" height="11.5" rx="1.5" />
    <path d="M1.5 5.75h2.75M1.5 10.25h2.75M11.75 5.75h2.75M11.75 10.25h2.75" />
  </>,
);

const FunctionIcon = icon(
  'function',
  <>
    {BOX}
    <path d="M10.2 4.9c-1.5-.5-2.3.2-2.5 1.6l-.6 3.3c-.2 1.1-.8 1.6-1.8 1.4M5.9 7.4h3.7" />
  </>,
);

export default textKind({
  kind: 'pou',
  icon: Program,
  subkinds: {
    program: { icon: Program, short: 'PRG' },
    function_block: { icon: FunctionBlock, short: 'FB' },
    function: { icon: FunctionIcon, short: 'FUN' },
  },
  parts: ['declaration', 'implementation'],
  add: {
    first: true,
    optionsOf: (subkind) => {
      if (subkind === 'function_block') return ['extends', 'implements'];
      return subkind === 'function' ? ['returns'] : [];
    },
    declarationOf: ({ subkind, name, values: { extends: base, implements: interfaces, returns } }) => {
      const heritage = `${base ? ` EXTENDS ${base}` : ''}${interfaces ? ` IMPLEMENTS ${interfaces}` : ''}`;
      if (subkind === 'function_block' && heritage)
        return `FUNCTION_BLOCK ${name}${heritage}\nVAR_INPUT\nEND_VAR\nVAR_OUTPUT\nEND_VAR\nVAR\nEND_VAR`;
      if (subkind === 'function' && returns) return `FUNCTION ${name} : ${returns}\nVAR_INPUT\nEND_VAR\nVAR\nEND_VAR`;
      return null;
    },
  },
  online: {
    valuesOf: (subkind) => {
      if (subkind === 'program') return 'program';
      return subkind === 'function_block' ? 'instance' : 'call';
    },
  },
  catalog: 'pous',
  countedAs: (subkind) => (subkind === 'program' ? 'programs' : subkind === 'function_block' ? 'blocks' : 'functions'),
});
