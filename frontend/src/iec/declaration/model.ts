/**
 * The declaration part of an object as the table shows it: one header and numbered rows, each with the exact
 * ranges of its cells in the one text that both views share (DECL-02). Nothing here is a copy that must be
 * written back: edits replace ranges of the text, so comments, pragmas and unknown parts stay as they are.
 */

export interface Range {
  readonly start: number;
  readonly end: number;
}

export interface Cell extends Range {
  readonly text: string;
}

/** Which frame surrounds the rows; it decides scopes, separators and which columns exist. */
export type RowFrame = 'variables' | 'members' | 'enumeration';

export interface DeclarationHeader {
  /** PROGRAM, FUNCTION_BLOCK, FUNCTION, METHOD, PROPERTY, INTERFACE, ACTION, TYPE (upper case). */
  readonly keyword: Cell;
  readonly name: Cell | null;
  /** From the keyword to the last token of the header, `EXTENDS` and return type included. */
  readonly range: Range;
  /** EXTENDS base, when there is one. */
  readonly base: Cell | null;
  /** Type behind the colon of a function, method or property. */
  readonly returnType: Cell | null;
  readonly attributes: readonly Cell[];
  readonly comments: readonly Cell[];
}

export interface Block {
  readonly frame: RowFrame;
  /** VAR, VAR_INPUT ... upper case; STRUCT or UNION for members; empty for an enumeration. */
  readonly scope: string;
  /** CONSTANT, RETAIN, PERSISTENT and access specifiers in upper case, in the order written. */
  readonly flags: readonly string[];
  /** `VAR_INPUT CONSTANT`, `STRUCT`, or the opening parenthesis. */
  readonly head: Range;
  /** `END_VAR`, `END_STRUCT`, or the closing parenthesis. */
  readonly tail: Range;
}

export interface Row {
  /** Index into `blocks`. */
  readonly block: number;
  /** Rows that share one statement (`A, B : INT;`) have the same statement number. */
  readonly statement: number;
  /** How many names the statement declares. */
  readonly shared: number;
  /** Special rows are shown whole and are edited in the text view only (DECL-21). */
  readonly special: string | null;
  readonly name: Cell;
  readonly address: Cell | null;
  readonly type: Cell | null;
  /** `:=` or `REF=`. */
  readonly assign: Cell | null;
  readonly initial: Cell | null;
  readonly attributes: readonly Cell[];
  /** Comments of the row: those behind it if there are any, else those directly before it. */
  readonly comments: readonly Cell[];
  readonly commentsBehind: boolean;
  /** Leading comments and pragmas together with the declaration, without separator. */
  readonly core: Range;
  /** The declaration alone, from first name to the last token before the separator. */
  readonly element: Range;
  /** `;` or `,`; null behind the last value of an enumeration. */
  readonly separator: Range | null;
  /** Comments and pragmas behind the separator in the same line; empty range when none. */
  readonly trail: Range;
}

export type ProblemKind =
  | 'unexpected' // a token that begins no declaration
  | 'missing-colon'
  | 'missing-type'
  | 'missing-semicolon'
  | 'missing-end'
  | 'missing-name'
  | 'not-tabular'; // an alias or subrange type: correct, but no list of rows

export interface DeclarationProblem extends Range {
  readonly kind: ProblemKind;
  /** The offending text, or what is missing. */
  readonly subject: string;
}

export interface DeclarationModel {
  readonly text: string;
  readonly header: DeclarationHeader | null;
  /** Pragmas before the first block of a text without header: those of a whole variable list (GVL-06). */
  readonly listAttributes: readonly Cell[];
  readonly blocks: readonly Block[];
  readonly rows: readonly Row[];
  readonly problems: readonly DeclarationProblem[];
}

export const VARIABLE_FLAGS = ['CONSTANT', 'RETAIN', 'PERSISTENT'] as const;

/** Scopes that may be chosen for a variable of an object of this kind (DECL-26, LDEC-20..LDEC-32). */
export function scopesFor(headerKeyword: string | null): readonly string[] {
  switch (headerKeyword) {
    case null:
      return ['VAR_GLOBAL', 'VAR_CONFIG'];
    case 'FUNCTION':
      return ['VAR', 'VAR_INPUT', 'VAR_OUTPUT', 'VAR_IN_OUT', 'VAR_STAT', 'VAR_EXTERNAL'];
    case 'METHOD':
      return ['VAR', 'VAR_INPUT', 'VAR_OUTPUT', 'VAR_IN_OUT', 'VAR_STAT', 'VAR_INST', 'VAR_EXTERNAL'];
    case 'INTERFACE':
      return ['VAR_INPUT', 'VAR_OUTPUT', 'VAR_IN_OUT'];
    case 'PROPERTY':
    case 'GET':
    case 'SET':
      return ['VAR'];
    default:
      return ['VAR', 'VAR_INPUT', 'VAR_OUTPUT', 'VAR_IN_OUT', 'VAR_TEMP', 'VAR_STAT', 'VAR_EXTERNAL'];
  }
}

/** The line break this text uses. */
export function lineBreakOf(text: string): '\n' | '\r\n' {
  return text.includes('\r\n') ? '\r\n' : '\n';
}
