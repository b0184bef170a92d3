/** Watch lists and forces as text files: one expression a line, behind it a format or a value. Pure functions. */
import { NUMBER_FORMATS, type NumberFormat } from '@/text/settings';

export interface ListedExpression {
  readonly expression: string;
  readonly format?: NumberFormat;
}

export interface ListedForce {
  readonly expression: string;
  readonly literal: string;
}

const isFormat = (text: string): text is NumberFormat => (NUMBER_FORMATS as readonly string[]).includes(text);

export function listText(entries: readonly ListedExpression[]): string {
  return entries.map(({ expression, format }) => `${expression}${format ? `\t${format}` : ''}\n`).join('');
}

/** Blank lines, and those that begin with `//`, say nothing. */
export function listFrom(text: string): ListedExpression[] {
  return lines(text).map((line) => {
    const [expression = '', format = ''] = line.split('\t').map((part) => part.trim());
    return isFormat(format) ? { expression, format } : { expression };
  });
}

export function forcesText(forces: readonly ListedForce[]): string {
  return forces.map(({ expression, literal }) => `${expression} := ${literal};\n`).join('');
}

/** Assignments `PLC_PRG.x := 5;`; lines that are none come back in `wrong`, by number. */
export function forcesFrom(text: string): { forces: ListedForce[]; wrong: number[] } {
  const forces: ListedForce[] = [];
  const wrong: number[] = [];
  text.split(/\r?\n/).forEach((line, at) => {
    if (line.trim() === '' || line.trim().startsWith('//')) return;
    const match = /^\s*([^:=]+?)\s*:=\s*(.+?)\s*;?\s*$/.exec(line);
    if (match === null) wrong.push(at + 1);
    else forces.push({ expression: match[1]!, literal: match[2]! });
  });
  return { forces, wrong };
}

function lines(text: string): string[] {
  return text.split(/\r?\n/).filter((line) => line.trim() !== '' && !line.trim().startsWith('//'));
}
