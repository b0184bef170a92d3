/** Comment texts between their delimiters and the cell that shows them (DECL-29). */

/** The plain text of one comment token, without delimiters and the blank next to them. */
function commentText(token: string): string {
  if (token.startsWith('//')) return token.slice(2).replace(/^ /, '').trimEnd();
  const inner = token.replace(/^\(\*/, '').replace(/\*\)$/, '');
  return inner
    .split(/\r?\n/)
    .map((line, index) => (index === 0 ? line : line.replace(/^\s*\*? ?/, '')))
    .join('\n')
    .trim();
}

/** The text of several comment tokens, one line each. */
export function joinComments(tokens: readonly string[]): string {
  return tokens.map(commentText).join('\n');
}

/** A comment behind a declaration: the delimiters of `like` are kept where they can hold the text. */
export function commentBehind(text: string, like: string | null): string {
  if (like !== null && like.startsWith('(*') && !text.includes('*)') && !text.includes('(*')) {
    return text === '' ? '' : `(* ${text} *)`;
  }
  return `// ${text}`.trimEnd();
}

/** `//` lines to stand above a declaration. */
export function commentLines(text: string): string[] {
  return text.split('\n').map((line) => `// ${line}`.trimEnd());
}
