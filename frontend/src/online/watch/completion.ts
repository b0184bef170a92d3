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

/** Whether the text is the full path of a variable; Enter then takes it as it is. */
export async function isComplete(tree: SymbolTree, text: string): Promise<boolean> {
  const typed = text.trim().toUpperCase();
  const children = await tree.children(splitExpression(text.trim()).path);
  return children.some((child) => child.path.toUpperCase() === typed);
}

/** Which suggestion Enter takes at once: the first, unless nothing is typed of the name or all of it is. */
export function preselected(items: readonly ExpressionCompletion[], text: string, complete: boolean): number {
  const typed = text.trim();
  return typed === '' || typed.endsWith('.') || complete || items.length === 0 ? -1 : 0;
}
