import type { LanguageBody } from '@/text/languages';
import { ImplementationPane } from './ImplementationPane';

const body: LanguageBody = { language: 'ST', view: ImplementationPane };

export default body;
