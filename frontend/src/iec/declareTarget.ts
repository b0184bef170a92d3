/** What the auto declare dialog proposes for a name. Pure. */
import { parseDeclaration } from './declaration/parse';
import { TYPE_PREFIXES } from './grammar';
import { findVariables } from './variables';

/** The type that a Hungarian prefix stands for (`xStart` is BOOL), else `otherwise`. */
export function typeByName(name: string, otherwise: string): string {
  const prefix = /^(?:g_|c_|gc_)?([a-z]+)(?=[A-Z_])/.exec(name)?.[1] ?? '';
  return TYPE_PREFIXES[prefix] ?? otherwise;
}

export interface LineName {
  readonly name: string;
  /** Offset in the text. */
  readonly start: number;
}

/** Plain names used in a line that the declaration does not know; they may still be global. */
export function undeclaredCandidates(
  body: string,
  lineStart: number,
  lineEnd: number,
  declaration: string,
): readonly LineName[] {
  const declared = new Set(parseDeclaration(declaration).rows.map((row) => row.name.text.toUpperCase()));
  const names = new Map<string, LineName>();
  for (const use of findVariables(body)) {
    if (use.start < lineStart || use.end > lineEnd || use.path.root !== 'plain') continue;
    const first = use.path.parts[0];
    if (first?.kind !== 'name' || first.name.startsWith('%') || declared.has(first.name.toUpperCase())) continue;
    if (!names.has(first.name.toUpperCase()))
      names.set(first.name.toUpperCase(), { name: first.name, start: use.start });
  }
  return [...names.values()];
}
