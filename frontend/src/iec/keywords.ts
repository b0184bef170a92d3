/** Which words of the language are reserved (LDEC section 9), and what can be a name. */

import {
  CONSTANT_KEYWORDS,
  DECLARATION_KEYWORDS,
  ELEMENTARY_TYPES,
  NAME,
  OPERATOR_FUNCTIONS,
  OPERATOR_KEYWORDS,
  STATEMENT_KEYWORDS,
} from './grammar';

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

export type IdentifierProblem = 'empty' | 'characters' | 'underscores' | 'reserved';

/** Why `name` cannot be the name of a variable or object, or null when it can (LDEC-05..LDEC-10). */
export function identifierProblem(name: string): IdentifierProblem | null {
  if (name === '') return 'empty';
  if (!NAME.test(name)) return 'characters';
  if (name.includes('__')) return 'underscores';
  if (isReserved(name)) return 'reserved';
  return null;
}
