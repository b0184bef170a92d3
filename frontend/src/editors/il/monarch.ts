/** Colours of IL: the words of ST, but other ones are keywords at the beginning of a row. */
import type { languages } from 'monaco-editor/editor/editor.api';
import { monarchLanguage } from '@/text/iecText';
import { OPERATORS } from './operators';

const OPERATOR = new RegExp(`(?:${OPERATORS.join('|')})(?![\\w\\u0080-\\uffff.#])`);

/** The first word of a row is an operator, also behind a label. */
const tokens: languages.IMonarchLanguage = {
  ...monarchLanguage,
  tokenizer: {
    ...monarchLanguage.tokenizer,
    root: [
      [/^\s*[A-Z_\u0080-\uffff][\w\u0080-\uffff]*\s*:(?!=)/, { token: 'annotation', next: '@labelled' }],
      [new RegExp(`^\\s*${OPERATOR.source}`), 'keyword'],
      ...(monarchLanguage.tokenizer['root'] ?? []),
    ],
    labelled: [
      [/\s+/, ''],
      [OPERATOR, 'keyword', '@pop'],
      [/(?=.)/, '', '@pop'],
    ],
  },
};

export default tokens;
