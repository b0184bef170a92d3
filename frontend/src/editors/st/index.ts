import type { LanguageDescriptor } from '@/text/languages';
import type en from './en.json';
import { FormatOptions } from './FormatOptions';

declare module '@/i18n' {
  interface TextTables {
    st: typeof en;
  }
}

const descriptor: LanguageDescriptor = {
  language: 'ST',
  options: { title: 'format.title', order: 1, component: FormatOptions },
};

export default descriptor;
