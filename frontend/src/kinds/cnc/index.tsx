import { icon } from '@/icons/shape';
import type { ObjectKindDescriptor } from '@/project/kinds';
import { onDemand } from '@/ui/onDemand';
import { CNC_TEXT } from './languageName';
import type en from './en.json';

declare module '@/i18n' {
  interface TextTables {
    cnc: typeof en;
  }
}

const descriptor: ObjectKindDescriptor = {
  kind: 'cnc',
  icon: icon(
    'task',
    <>
      <path d="M2.25 13.25h4.5a3.25 3.25 0 0 0 0-6.5h-1" />
      <path d="M9.5 2h4.25v2.75L11.6 7.4 9.5 4.75z" />
    </>,
  ),
  parts: ['implementation'],
  textLanguage: CNC_TEXT,
  compiled: true,
  editor: onDemand(() => import('./CncEditor')),
  properties: onDemand(() => import('./CncProperties')),
};

export default descriptor;
