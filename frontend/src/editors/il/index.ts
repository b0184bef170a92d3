import type { LanguageDescriptor } from '@/text/languages';
import { ilCommands } from './commands';
import type en from './en.json';
import { IlOptions } from './IlOptions';

declare module '@/i18n' {
  interface TextTables {
    il: typeof en;
  }
}

const descriptor: LanguageDescriptor = {
  language: 'IL',
  commands: ilCommands,
  options: { title: 'il.options', order: 2, component: IlOptions },
  text: { id: 'iec-il', tokens: async () => (await import('./monarch')).default },
};

export default descriptor;
