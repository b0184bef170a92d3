import type { LanguageBody } from '@/text/bodies';
import { ilHandlers } from './handlers';
import { IlPane } from './IlPane';
import { isInstructionList, operandTokens } from './instructionList';

const body: LanguageBody = {
  language: 'IL',
  view: IlPane,
  handlers: ilHandlers,
  valueTokens: (text, tokens) => (isInstructionList(text, tokens) ? operandTokens(text, tokens) : null),
};

export default body;
