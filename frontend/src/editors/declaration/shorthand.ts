/** Shorthand declarations: `A B I 2; text` and Ctrl+Enter give `A, B: INT := 2; (* text *)` (DECL-61..DECL-66). */
import { tokenize, textOf } from '../st/lexer';

const TYPES: Readonly<Record<string, string>> = {
  B: 'BOOL',
  BOOL: 'BOOL',
  I: 'INT',
  INT: 'INT',
  R: 'REAL',
  REAL: 'REAL',
  S: 'STRING',
  STRING: 'STRING',
};

/** The complete declaration for a shorthand line, or null when the line holds no name to declare. */
export function expandShorthand(line: string): string | null {
  const semicolon = line.indexOf(';');
  const comment = semicolon < 0 ? '' : line.slice(semicolon + 1).trim();
  const code = semicolon < 0 ? line : line.slice(0, semicolon);
  const tokens = tokenize(code);
  const words = tokens.filter((token) => token.kind === 'word').map((token) => textOf(code, token));
  const address = tokens.find((token) => token.kind === 'address');
  const constant = tokens.find((token) => ['number', 'string', 'wstring'].includes(token.kind));
  const named = words.length > 1 ? TYPES[(words[words.length - 1] ?? '').toUpperCase()] : undefined;
  const names = named === undefined ? words : words.slice(0, -1);
  if (names.length === 0) return null;
  const type = named ?? 'BOOL';
  const at = address === undefined ? '' : ` AT ${textOf(code, address)}`;
  const value =
    constant === undefined ? '' : typedValue(type, textOf(code, constant), signBefore(code, constant.start));
  const behind = comment === '' ? '' : ` (* ${comment} *)`;
  return `${names.join(', ')}${at}: ${type}${value};${behind}`;
}

function signBefore(code: string, at: number): string {
  return /-\s*$/.test(code.slice(0, at)) ? '-' : '';
}

function typedValue(type: string, constant: string, sign: string): string {
  if (type === 'STRING' && /^\d+$/.test(constant)) return `(${constant})`;
  if (type === 'REAL' && /^\d+$/.test(constant)) return ` := ${sign}${constant}.0`;
  return ` := ${sign}${constant}`;
}
