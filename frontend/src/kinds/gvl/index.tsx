import { textKind } from '@/editors/textObject/textKind';
import { icon } from '@/icons/shape';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    gvl: typeof en;
  }
}

const Globals = icon(
  'variables',
  <>
    <circle cx="8" cy="8" r="5.9" />
    <path d="M2.2 8h11.6M8 2.1c2.1 1.7 2.9 3.7 2.9 5.9s-.8 4.2-2.9 5.9c-2.1-1.7-2.9-3.7-2.9-5.9S5.9 3.8 8 2.1z" />
  </>,
);

const ParameterList = icon(
  'variables',
  <>
    <path d="M2.25 4h6M11.75 4h2M2.25 8h1.5M7.25 8h6.5M2.25 12h5M10.75 12h3" />
    <path d="M10 2.25v3.5M5.5 6.25v3.5M9 10.25v3.5" />
  </>,
);

export default textKind({
  kind: 'gvl',
  icon: Globals,
  // Libraries call their lists `global`.
  subkinds: { parameter_list: { icon: ParameterList }, variable_list: {}, global: {} },
  parts: ['declaration'],
  online: { valuesOf: () => 'global' },
  declares: 'VAR_GLOBAL',
  countedAs: () => 'lists',
});
