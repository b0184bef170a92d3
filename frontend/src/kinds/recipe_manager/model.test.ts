import { expect, test } from 'vitest';
import { exampleLine, extensionFault, folderFault, withColumn, type FileColumn, type RecipeManager } from './model';

const COLUMNS: readonly FileColumn[] = ['variable', 'type', 'value'];

test('a column takes its place', () => {
  expect(withColumn(COLUMNS, 1, 'comment')).toEqual(['variable', 'comment', 'value']);
  expect(withColumn(COLUMNS, 3, 'name')).toEqual(['variable', 'type', 'value', 'name']);
});

test('a column that is there already trades places', () => {
  expect(withColumn(COLUMNS, 0, 'value')).toEqual(['value', 'type', 'variable']);
  expect(withColumn(COLUMNS, 3, 'type')).toEqual(COLUMNS);
});

test('variable and value stay', () => {
  expect(withColumn(COLUMNS, 0, 'none')).toEqual(COLUMNS);
  expect(withColumn(COLUMNS, 2, 'none')).toEqual(COLUMNS);
  expect(withColumn(COLUMNS, 1, 'none')).toEqual(['variable', 'value']);
});

test('folders and extensions', () => {
  expect(['', 'a', 'a/b c'].filter(folderFault)).toEqual([]);
  expect(['..', 'a/../b', '/a', 'a\\b', 'c:'].filter((path) => !folderFault(path))).toEqual([]);
  expect(['txt', 'TXT_1'].filter(extensionFault)).toEqual([]);
  expect(['', '.txt', 'a/b'].filter((text) => !extensionFault(text))).toEqual([]);
});

test('a line', () => {
  const manager = { columns: ['name', 'variable', 'value'], separator: ';' } as unknown as RecipeManager;
  expect(exampleLine(manager)).toBe('Temperature;PLC_PRG.rTemperature;180.0');
});
