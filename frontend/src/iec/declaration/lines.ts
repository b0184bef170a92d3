/** Rows of a declaration by the lines of its text. Pure functions. */
import type { DeclarationModel } from './model';

/** The rows whose declarations stand in one of the lines, or reach over it. */
export function rowsInLines(model: DeclarationModel, lines: readonly number[]): ReadonlySet<number> {
  if (lines.length === 0) return new Set();
  const lineOf = (offset: number) => model.text.slice(0, offset).split('\n').length;
  return new Set(
    model.rows.flatMap(({ element }, row) => {
      const [first, last] = [lineOf(element.start), lineOf(element.end)];
      return lines.some((line) => line >= first && line <= last) ? [row] : [];
    }),
  );
}
