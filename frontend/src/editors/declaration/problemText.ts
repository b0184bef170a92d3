import { t } from '@/i18n';
import type { DeclarationProblem } from '@/iec/declaration/model';

/** What is wrong in the declaration and what would be right. */
export function problemText(problem: DeclarationProblem): string {
  return t(`decl.problem.${problem.kind}`, { subject: problem.subject });
}

/** Line and column of an offset, counted from 1. */
export function placeOf(text: string, offset: number): { line: number; column: number } {
  const before = text.slice(0, offset);
  const line = before.split('\n').length;
  return { line, column: offset - before.lastIndexOf('\n') };
}
