import { describe, expect, test } from 'vitest';
import {
  addRecipe,
  addVariables,
  cellFault,
  cellText,
  freeName,
  moveVariables,
  nameFault,
  recipeColumn,
  removeRecipe,
  removeVariables,
  renameRecipe,
  setCell,
  setValues,
  type RecipeDefinition,
  offered,
} from './model';

const row = (path: string) => ({ path, name: '', minimum: '', maximum: '', comment: '' });
const BREAD: RecipeDefinition = {
  variables: [row('PLC_PRG.a'), row('PLC_PRG.b[2].c'), row('GVL.d')],
  recipes: [
    { name: 'Light', values: { 'PLC_PRG.a': '1', 'GVL.d': "'x'" } },
    { name: 'Dark', values: { 'PLC_PRG.b[2].c': 'TRUE' } },
  ],
};
const paths = (definition: RecipeDefinition) => definition.variables.map(({ path }) => path);

test('cells show facts and values', () => {
  expect(cellText(BREAD, 0, 'path')).toBe('PLC_PRG.a');
  expect(cellText(BREAD, 0, recipeColumn('Light'))).toBe('1');
  expect(cellText(BREAD, 1, recipeColumn('Light'))).toBe('');
  expect(cellText(BREAD, 9, 'path')).toBe('');
});

test('a value is set, and taken out by an empty text', () => {
  const set = setCell(BREAD, 1, recipeColumn('Light'), ' FALSE ');
  expect(set.recipes[0]?.values['PLC_PRG.b[2].c']).toBe('FALSE');
  expect(setCell(set, 1, recipeColumn('Light'), '').recipes).toEqual(BREAD.recipes);
});

test('values follow the path of their variable', () => {
  const moved = setCell(BREAD, 0, 'path', 'PLC_PRG.z');
  expect(paths(moved)[0]).toBe('PLC_PRG.z');
  expect(moved.recipes[0]?.values).toEqual({ 'PLC_PRG.z': '1', 'GVL.d': "'x'" });
});

test('variables are added once, at their place', () => {
  const more = addVariables(BREAD, ['gvl.D', 'GVL.e', 'GVL.E', 'no path', ''], 1);
  expect(paths(more)).toEqual(['PLC_PRG.a', 'GVL.e', 'PLC_PRG.b[2].c', 'GVL.d']);
  expect(addVariables(BREAD, ['GVL.d'], 0)).toBe(BREAD);
});

test('variables go with their values', () => {
  const less = removeVariables(BREAD, new Set([0, 1]));
  expect(paths(less)).toEqual(['GVL.d']);
  expect(less.recipes.map(({ values }) => values)).toEqual([{ 'GVL.d': "'x'" }, {}]);
});

test('rows are moved', () => {
  expect(paths(moveVariables(BREAD, new Set([2]), 0))).toEqual(['GVL.d', 'PLC_PRG.a', 'PLC_PRG.b[2].c']);
  expect(paths(moveVariables(BREAD, new Set([0, 1]), 3))).toEqual(['GVL.d', 'PLC_PRG.a', 'PLC_PRG.b[2].c']);
});

test('recipes are added, renamed and removed', () => {
  const copied = addRecipe(BREAD, ' Rye ', 'Light');
  expect(copied.recipes[2]).toEqual({ name: 'Rye', values: BREAD.recipes[0]?.values });
  expect(addRecipe(BREAD, 'Rye', null).recipes[2]?.values).toEqual({});
  expect(renameRecipe(BREAD, 'Dark', 'Black').recipes.map(({ name }) => name)).toEqual(['Light', 'Black']);
  expect(removeRecipe(BREAD, 'Light').recipes.map(({ name }) => name)).toEqual(['Dark']);
  expect(freeName(addRecipe(BREAD, 'recipe1', null), 'Recipe')).toBe('Recipe2');
  expect(setValues(BREAD, 'Dark', { 'GVL.d': "''" }).recipes[1]?.values['GVL.d']).toBe("''");
});

describe('what is refused', () => {
  test.each(['', '.a', 'a/b', 'a\\b', 'x'.repeat(81)])('the recipe %j', (name) => {
    expect(nameFault(BREAD, name, null)).toBe('name');
  });
  test('a recipe that is there', () => {
    expect(nameFault(BREAD, 'light', null)).toBe('nameTaken');
    expect(nameFault(BREAD, 'light', 'Light')).toBeNull();
  });
  test.each(['', '5', 'a b', 'a..b', 'a;b', 'a[', 'a.b := 1'])('the path %j', (path) => {
    expect(cellFault(BREAD, 0, 'path', path)).toBe('path');
  });
  test('a path that is there', () => {
    expect(cellFault(BREAD, 0, 'path', 'gvl.d')).toBe('taken');
    expect(cellFault(BREAD, 2, 'path', 'gvl.d')).toBeNull();
  });
  test.each(['5;', '5 + 5', "'a", "'a'b'", 'x := 1', '..'])('the value %j', (value) => {
    expect(cellFault(BREAD, 0, recipeColumn('Light'), value)).toBe('value');
    expect(cellFault(BREAD, 0, 'minimum', value)).toBe('value');
  });
});

test.each(['', '5', '-1.5E-3', '16#F0', 'INT#-5', 'TRUE', 'T#1h2m', 'D#2026-01-01', "'it$'s'", '"ü"', 'E_Mode.Auto'])(
  'the value %j is taken',
  (value) => {
    expect(cellFault(BREAD, 0, recipeColumn('Light'), value)).toBeNull();
  },
);

describe('what can be added', () => {
  test('has a whole before its first member, or at the end where no member is offered', () => {
    const one = (path: string) => ({ path, type: 'INT' });
    const rows = offered(
      [one('P.a'), one('P.fb.in.x'), one('P.fb.q'), one('P.arr[1]')],
      [one('P.fb'), one('P.fb.in'), one('P.arr'), one('P.ar')],
    );
    expect(rows.map(({ path, whole }) => (whole ? `(${path})` : path))).toEqual([
      'P.a', '(P.fb)', '(P.fb.in)', 'P.fb.in.x', 'P.fb.q', '(P.arr)', 'P.arr[1]', '(P.ar)',
    ]); // prettier-ignore
  });
});
