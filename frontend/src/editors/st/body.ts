import type { LanguageBody } from '@/text/bodies';
import { ImplementationPane } from '../text/ImplementationPane';

const body: LanguageBody = { language: 'ST', view: ImplementationPane, showsOthers: true };

export default body;
