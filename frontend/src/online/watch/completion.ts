/** Completion of watch expressions from the symbol tree. */
import type { SymbolTree } from '../symbols';

export interface ExpressionCompletion {
  readonly name: string;
  readonly expression: string;
  readonly type: string;
  readonly leaf: boolean;
}

/** Splits `PLC_PRG.fb1.ab` into the path that is complete and the beginning of the next name. */
export function splitExpression(text: string): { path: string; start: string } {
  const bracket = text.lastIndexOf('[');
  const dot = text.lastIndexOf('.');
  if (bracket > dot && !text.includes(']', bracket))
    return { path: text.slice(0, bracket), start: text.slice(bracket) };
  if (dot < 0) return { path: '', start: text };
  return { path: text.slice(0, dot), start: text.slice(dot + 1) };
}

/** Variables that continue the text, those that begin with it first; nothing when it is complete. */
export async function completionsFor(tree: SymbolTree, text: string): Promise<readonly ExpressionCompletion[]> {
  const { path, start } = splitExpression(text.trim());
  const children = await tree.children(path);
  const wanted = start.toUpperCase();
  const fits = children
    .filter(
      (child) => child.name.toUpperCase().startsWith(wanted) && child.path.toUpperCase() !== text.trim().toUpperCase(),
    )
    .map(({ name, path: expression, type, leaf }) => ({ name, expression, type, leaf }));
  return fits.slice(0, 200);
}
