/** The settings of a recipe manager. */
import type { Schemas } from '@/api/types';

export type RecipeManager = Schemas['RecipeManagerData'];
export type FileColumn = RecipeManager['columns'][number];
export type Separator = RecipeManager['separator'];

export const FILE_COLUMNS = [
  'variable',
  'type',
  'name',
  'minimum',
  'maximum',
  'comment',
  'value',
] as const satisfies readonly FileColumn[];
export const SEPARATORS = [':=', ';', ',', '\t', ' ', '|'] as const satisfies readonly Separator[];

const EXAMPLE: Readonly<Record<FileColumn, string>> = {
  variable: 'PLC_PRG.rTemperature',
  type: 'REAL',
  name: 'Temperature',
  minimum: '20.0',
  maximum: '250.0',
  comment: '°C',
  value: '180.0',
};

export const folderFault = (path: string) =>
  path.startsWith('/') || path.split('/').includes('..') || /[\\:*?]/.test(path);
export const extensionFault = (text: string) => !/^[A-Za-z0-9_]{1,20}$/.test(text);

/** What can be saved. */
export function isValid(manager: RecipeManager): boolean {
  return !folderFault(manager.path) && !extensionFault(manager.extension);
}

/** The columns with another one in a place; 'none' removes it. Variable and value stay, a column that is there trades places. */
export function withColumn(
  columns: readonly FileColumn[],
  place: number,
  column: FileColumn | 'none',
): readonly FileColumn[] {
  const before = columns[place];
  if (column === 'none')
    return before === 'variable' || before === 'value' ? columns : columns.filter((_, at) => at !== place);
  const next = columns.map((one, at) =>
    at === place ? column : one === column && before !== undefined ? before : one,
  );
  return before === undefined && !columns.includes(column) ? [...next, column] : next;
}

/** A line of a file with these settings. */
export function exampleLine(manager: RecipeManager): string {
  return manager.columns.map((column) => EXAMPLE[column]).join(manager.separator);
}
