/** The reserved words of the language (LDEC section 9), grouped the way the editors need them. */

export const DECLARATION_KEYWORDS = [
  'PROGRAM',
  'END_PROGRAM',
  'FUNCTION',
  'END_FUNCTION',
  'FUNCTION_BLOCK',
  'END_FUNCTION_BLOCK',
  'METHOD',
  'END_METHOD',
  'ACTION',
  'END_ACTION',
  'PROPERTY',
  'END_PROPERTY',
  'GET',
  'SET',
  'INTERFACE',
  'END_INTERFACE',
  'EXTENDS',
  'IMPLEMENTS',
  'PUBLIC',
  'PRIVATE',
  'PROTECTED',
  'INTERNAL',
  'FINAL',
  'ABSTRACT',
  'TYPE',
  'END_TYPE',
  'STRUCT',
  'END_STRUCT',
  'UNION',
  'END_UNION',
  'VAR',
  'VAR_INPUT',
  'VAR_OUTPUT',
  'VAR_IN_OUT',
  'VAR_GLOBAL',
  'VAR_TEMP',
  'VAR_STAT',
  'VAR_INST',
  'VAR_EXTERNAL',
  'VAR_CONFIG',
  'VAR_ACCESS',
  'END_VAR',
  'CONSTANT',
  'RETAIN',
  'PERSISTENT',
  'AT',
  'ARRAY',
  'POINTER',
  'REFERENCE',
  'PARAMS',
  'READ_ONLY',
  'READ_WRITE',
] as const;

export const STATEMENT_KEYWORDS = [
  'IF',
  'THEN',
  'ELSIF',
  'ELSE',
  'END_IF',
  'CASE',
  'OF',
  'END_CASE',
  'FOR',
  'TO',
  'BY',
  'DO',
  'END_FOR',
  'WHILE',
  'END_WHILE',
  'REPEAT',
  'UNTIL',
  'END_REPEAT',
  'EXIT',
  'CONTINUE',
  'RETURN',
  'JMP',
  'SUPER',
  'THIS',
] as const;

export const OPERATOR_KEYWORDS = ['AND', 'OR', 'XOR', 'NOT', 'MOD', 'AND_THEN', 'OR_ELSE'] as const;

/** Types whose literals are numbers, or TRUE and FALSE. */
export const NUMERIC_TYPES = [
  'BOOL',
  'BYTE',
  'WORD',
  'DWORD',
  'LWORD',
  'SINT',
  'INT',
  'DINT',
  'LINT',
  'USINT',
  'UINT',
  'UDINT',
  'ULINT',
  'REAL',
  'LREAL',
] as const;

export const ELEMENTARY_TYPES = [
  ...NUMERIC_TYPES,
  'STRING',
  'WSTRING',
  'TIME',
  'LTIME',
  'DATE',
  'LDATE',
  'TIME_OF_DAY',
  'TOD',
  'LTIME_OF_DAY',
  'LTOD',
  'DATE_AND_TIME',
  'DT',
  'LDATE_AND_TIME',
  'LDT',
  'BIT',
] as const;

export const OPERATOR_FUNCTIONS = [
  'ABS',
  'ACOS',
  'ADD',
  'ADR',
  'ASIN',
  'ATAN',
  'BITADR',
  'COS',
  'DIV',
  'EQ',
  'EXP',
  'EXPT',
  'GE',
  'GT',
  'INDEXOF',
  'LE',
  'LIMIT',
  'LN',
  'LOG',
  'LT',
  'MAX',
  'MIN',
  'MOVE',
  'MUL',
  'MUX',
  'NE',
  'ROL',
  'ROR',
  'SEL',
  'SHL',
  'SHR',
  'SIN',
  'SIZEOF',
  'SQRT',
  'SUB',
  'TAN',
  'TRUNC',
  'TRUNC_INT',
] as const;

export const CONSTANT_KEYWORDS = ['TRUE', 'FALSE', 'NULL'] as const;

const RESERVED: ReadonlySet<string> = new Set<string>([
  ...DECLARATION_KEYWORDS,
  ...STATEMENT_KEYWORDS,
  ...OPERATOR_KEYWORDS,
  ...ELEMENTARY_TYPES,
  ...OPERATOR_FUNCTIONS,
  ...CONSTANT_KEYWORDS,
]);

/** Words that are fine as names although they are words of a construct in one place only. */
const CONTEXTUAL: ReadonlySet<string> = new Set(['GET', 'SET', 'BIT', 'PARAMS', 'NULL', 'INDEXOF']);

/** Whether `name` may not be declared by a user (LDEC-10), in any spelling. */
function isReserved(name: string): boolean {
  const upper = name.toUpperCase();
  if (CONTEXTUAL.has(upper)) return false;
  return RESERVED.has(upper) || isConversion(upper);
}

/** Whether `name` has a keyword meaning somewhere; used for colouring and to skip words in expressions. */
export function isKeyword(name: string): boolean {
  return RESERVED.has(name.toUpperCase());
}

const TYPE_NAMES: ReadonlySet<string> = new Set<string>(ELEMENTARY_TYPES);

/** `INT_TO_REAL`, `TO_INT`, `ANY_TO_STRING` ... (LOPR conversions). */
export function isConversion(name: string): boolean {
  const upper = name.toUpperCase();
  const to = upper.startsWith('TO_') ? 0 : upper.indexOf('_TO_');
  if (to < 0) return false;
  const from = upper.startsWith('TO_') ? '' : upper.slice(0, to);
  const target = upper.startsWith('TO_') ? upper.slice(3) : upper.slice(to + 4);
  return TYPE_NAMES.has(target) && (from === '' || from === 'ANY' || TYPE_NAMES.has(from));
}

const IDENTIFIER = /^[A-Za-z_\u0080-\uffff][A-Za-z0-9_\u0080-\uffff]*$/;

export type IdentifierProblem = 'empty' | 'characters' | 'underscores' | 'reserved';

/** Why `name` cannot be the name of a variable or object, or null when it can (LDEC-05..LDEC-10). */
export function identifierProblem(name: string): IdentifierProblem | null {
  if (name === '') return 'empty';
  if (!IDENTIFIER.test(name)) return 'characters';
  if (name.includes('__')) return 'underscores';
  if (isReserved(name)) return 'reserved';
  return null;
}
