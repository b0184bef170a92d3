/** IEC texts for Monaco: grammar for colours, brackets, comments, indentation. */
import type { languages } from 'monaco-editor/editor/editor.api';
import {
  CONSTANT_KEYWORDS,
  DECLARATION_KEYWORDS,
  ELEMENTARY_TYPES,
  OPERATOR_FUNCTIONS,
  OPERATOR_KEYWORDS,
  STATEMENT_KEYWORDS,
} from '@/iec/grammar';

/** Monaco's name of what declarations are written in, and bodies without a form of their own; the language server's, too. */
export const IEC_TEXT = 'iec-st';

const OPENING =
  /^\s*(?:IF\b.*\bTHEN|ELSIF\b.*\bTHEN|ELSE|CASE\b.*\bOF|FOR\b.*\bDO|WHILE\b.*\bDO|REPEAT|VAR(?:_\w+)?\b(?!.*\bEND_VAR)[A-Z_ ]*|STRUCT|UNION)\s*(?:\/\/.*)?$/i;
const CLOSING = /^\s*(?:END_\w+|ELSIF\b|ELSE\b|UNTIL\b)/i;

export const languageConfiguration: languages.LanguageConfiguration = {
  comments: { lineComment: '//', blockComment: ['(*', '*)'] },
  brackets: [
    ['(', ')'],
    ['[', ']'],
    ['{', '}'],
  ],
  autoClosingPairs: [
    { open: '(', close: ')' },
    { open: '[', close: ']' },
    { open: '{', close: '}' },
    { open: "'", close: "'", notIn: ['string', 'comment'] },
    { open: '"', close: '"', notIn: ['string', 'comment'] },
    { open: '(*', close: '*)', notIn: ['string', 'comment'] },
  ],
  surroundingPairs: [
    { open: '(', close: ')' },
    { open: '[', close: ']' },
    { open: "'", close: "'" },
    { open: '"', close: '"' },
  ],
  wordPattern: /[A-Za-z_\u0080-\uffff][A-Za-z0-9_\u0080-\uffff]*|%[A-Za-z0-9.*]+/,
  indentationRules: { increaseIndentPattern: OPENING, decreaseIndentPattern: CLOSING },
  folding: {
    markers: {
      start: /^\s*(?:\{region\b|(?:VAR(?:_\w+)?|STRUCT|UNION|IF|CASE|FOR|WHILE|REPEAT)\b(?!.*\bEND_))/i,
      end: /^\s*(?:\{endregion\b|END_(?:VAR|STRUCT|UNION|IF|CASE|FOR|WHILE|REPEAT)\b)/i,
    },
  },
};

export const monarchLanguage: languages.IMonarchLanguage = {
  ignoreCase: true,
  defaultToken: '',
  declarations: [...DECLARATION_KEYWORDS],
  statements: [...STATEMENT_KEYWORDS],
  wordOperators: [...OPERATOR_KEYWORDS],
  types: [...ELEMENTARY_TYPES],
  functions: [...OPERATOR_FUNCTIONS],
  constants: [...CONSTANT_KEYWORDS],
  brackets: [
    { open: '(', close: ')', token: 'delimiter.parenthesis' },
    { open: '[', close: ']', token: 'delimiter.square' },
  ],
  tokenizer: {
    root: [
      [/\/\/.*$/, 'comment'],
      [/\(\*/, 'comment', '@comment'],
      [/\{[^}\r\n]*\}?/, 'annotation'],
      [/(?:L?TIME|L?T)#[-+0-9A-Z_.]+/, 'number.time'],
      [/(?:L?DATE_AND_TIME|L?DT|L?DATE|L?D|L?TIME_OF_DAY|L?TOD)#[0-9:._-]+/, 'number.time'],
      [/[A-Z_]\w*#(?:[-+]?[0-9][0-9A-F_#.]*(?:E[-+]?[0-9]+)?|TRUE\b|FALSE\b)/, 'number'],
      [/[0-9]+#[0-9A-F_]+/, 'number'],
      [/[0-9][0-9_]*(?:\.(?!\.)[0-9_]+)?(?:E[-+]?[0-9]+)?/, 'number'],
      [/%[IQM](?:\*|[XBWDL]?[0-9]+(?:\.[0-9]+)*)/, 'variable.address'],
      [/'/, 'string', '@string'],
      [/"/, 'string', '@wideString'],
      [/REF=|[SR]=(?!=)|:=|=>|<=|>=|<>|\*\*|[-+*/=<>&]/, 'operator'],
      [
        /[A-Z_\u0080-\uffff][\w\u0080-\uffff]*(?=\s*\((?!\*))/,
        {
          cases: {
            '@declarations': 'keyword',
            '@statements': 'keyword',
            '@wordOperators': 'keyword.operator',
            '@types': 'type',
            '@functions': 'function.operator',
            '@default': 'function',
          },
        },
      ],
      [
        /[A-Z_\u0080-\uffff][\w\u0080-\uffff]*/,
        {
          cases: {
            '@declarations': 'keyword',
            '@statements': 'keyword',
            '@wordOperators': 'keyword.operator',
            '@types': 'type',
            '@constants': 'constant',
            '@functions': 'function.operator',
            '@default': 'identifier',
          },
        },
      ],
      [/[()[\]]/, '@brackets'],
      [/[;,.:^]/, 'delimiter'],
    ],
    comment: [
      [/[^(*]+/, 'comment'],
      [/\(\*/, 'comment', '@push'],
      [/\*\)/, 'comment', '@pop'],
      [/[(*]/, 'comment'],
    ],
    string: [
      [/[^'$]+$/, 'string', '@pop'],
      [/[^'$]+/, 'string'],
      [/\$(?:[$'LNPRT]|[0-9A-F]{2})/, 'string.escape'],
      [/\$/, 'string.invalid'],
      [/'/, 'string', '@pop'],
    ],
    wideString: [
      [/[^"$]+$/, 'string', '@pop'],
      [/[^"$]+/, 'string'],
      [/\$(?:[$"LNPRT]|[0-9A-F]{4})/, 'string.escape'],
      [/\$/, 'string.invalid'],
      [/"/, 'string', '@pop'],
    ],
  },
};
