import type { LanguageBody } from '@/text/languages';
import { ilHandlers } from './handlers';
import { IlPane } from './IlPane';

const body: LanguageBody = { language: 'IL', view: IlPane, handlers: ilHandlers };

export default body;
