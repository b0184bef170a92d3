/** What the text of an object says about it. Pure functions. */

export interface TextFacts {
  /** Who may use it: PUBLIC, PRIVATE ... as its header says; null where it says nothing. */
  access: string | null;
  /** ABSTRACT, FINAL, OVERRIDE. */
  modifiers: readonly string[];
  /** Attributes above the header, as they are written. */
  attributes: readonly string[];
  /** The comment above the header. */
  comment: string;
  lines: number;
  characters: number;
}

const LEADING = /^(?:\s+|\{[^}]*\}|\(\*[\s\S]*?\*\)|\/\/[^\n]*|\/\*[\s\S]*?\*\/)*/;
const COMMENT = /\(\*([\s\S]*?)\*\)|\/\/([^\n]*)|\/\*([\s\S]*?)\*\//g;
const ATTRIBUTE = /\{\s*attribute\s+([^}]*?)\s*\}/gi;
const ACCESS = ['PUBLIC', 'PRIVATE', 'PROTECTED', 'INTERNAL'];
const MODIFIERS = ['ABSTRACT', 'FINAL', 'OVERRIDE'];

export function factsOf(declaration: string, implementation: string): TextFacts {
  const leading = LEADING.exec(declaration)?.[0] ?? '';
  const header = declaration
    .slice(leading.length)
    .split('\n', 1)[0]!
    .toUpperCase()
    .split(/[\s:;(]+/);
  const whole = [declaration, implementation].filter((text) => text !== '').join('\n');
  const comments = [...leading.replaceAll(/\{[^}]*\}/g, '').matchAll(COMMENT)];
  return {
    access: ACCESS.find((word) => header.includes(word)) ?? null,
    modifiers: MODIFIERS.filter((word) => header.includes(word)),
    attributes: [...leading.matchAll(ATTRIBUTE)].map((match) => match[1]!),
    comment: comments
      .map((match) => (match[1] ?? match[2] ?? match[3] ?? '').trim())
      .filter(Boolean)
      .join('\n'),
    lines: whole === '' ? 0 : whole.split('\n').length,
    characters: whole.length,
  };
}
