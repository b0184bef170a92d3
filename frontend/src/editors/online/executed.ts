/** What flow control says of the lines of a body. Pure. */
import type { FlowSnapshot, FlowStatement } from '@/api/types';
import { expressionKey } from '@/online/item';

export class Executed {
  private readonly byLine = new Map<number, FlowStatement[]>();

  constructor({ statements }: FlowSnapshot) {
    for (const statement of statements)
      for (let line = statement.line; line <= statement.end_line; line += 1)
        this.byLine.set(line, [...(this.byLine.get(line) ?? []), statement]);
  }

  /** Executed lines, in order. */
  get lines(): number[] {
    return [...this.byLine.keys()].sort((a, b) => a - b);
  }

  has(line: number): boolean {
    return this.byLine.has(line);
  }

  /** The literal of a variable of a line right after its statement; null where that is not known. */
  valueAt(line: number, name: string): string | null {
    const key = expressionKey(name);
    // Of several statements in the line the last one that names it has the last word.
    const found = this.byLine
      .get(line)
      ?.flatMap(({ values }) => values.filter((one) => expressionKey(one.name) === key));
    return found?.at(-1)?.literal ?? null;
  }
}
