/** A recipe definition as a table: a row a variable, columns of facts, and a column a recipe. */
import type { Schemas } from '@/api/types';

export type RecipeDefinition = Schemas['RecipeDefinitionData'];
export type RecipeVariable = RecipeDefinition['variables'][number];
export type Recipe = RecipeDefinition['recipes'][number];
export type Fact = 'path' | 'name' | 'minimum' | 'maximum' | 'comment';

export const FACTS = ['path', 'name', 'minimum', 'maximum', 'comment'] as const satisfies readonly Fact[];
const RECIPE = 'recipe:';

export const recipeColumn = (name: string) => `${RECIPE}${name}`;
export const recipeOfColumn = (column: string) => (column.startsWith(RECIPE) ? column.slice(RECIPE.length) : null);
export const sameName = (one: string, other: string) => one.toUpperCase() === other.toUpperCase();

export function cellText(definition: RecipeDefinition, row: number, column: string): string {
  const variable = definition.variables[row];
  if (variable === undefined) return '';
  const recipe = recipeOfColumn(column);
  if (recipe === null) return variable[column as Fact] ?? '';
  return definition.recipes.find((one) => one.name === recipe)?.values[variable.path] ?? '';
}

const PATH = /^[\p{L}_][\p{L}\p{N}_]*(\[[-\w.:, ]+\])*(\.[\p{L}_][\p{L}\p{N}_]*(\[[-\w.:, ]+\])*)*$/u;
const LITERAL =
  /^([+-]?([a-z_]\w*#)?[+-]?(\d+#[\da-f_]+|\d[\w.]*([eE][+-]\d+)?)|true|false|(l?time|l?t)#[+-]?[\w.]+|l?(d|dt|date|tod|time_of_day|date_and_time)#\d[\d:.-]*|'([^'$]|\$.)*'|"([^"$]|\$.)*"|[\p{L}_][\p{L}\p{N}_]*([.#][\p{L}_][\p{L}\p{N}_]*)*)$/iu;

export type Fault = 'path' | 'taken' | 'value' | 'name' | 'nameTaken';

/** What is wrong with a text for a cell; null: it can be taken. The compiler says later whether it fits the variable. */
export function cellFault(definition: RecipeDefinition, row: number, column: string, text: string): Fault | null {
  const wanted = text.trim();
  if (column === 'path') {
    if (!PATH.test(wanted)) return 'path';
    return definition.variables.some(({ path }, at) => at !== row && sameName(path, wanted)) ? 'taken' : null;
  }
  if (column === 'name' || column === 'comment') return null;
  return wanted === '' || LITERAL.test(wanted) ? null : 'value';
}

export function setCell(definition: RecipeDefinition, row: number, column: string, text: string): RecipeDefinition {
  const variable = definition.variables[row];
  if (variable === undefined) return definition;
  const recipe = recipeOfColumn(column);
  const value = column === 'name' || column === 'comment' ? text : text.trim();
  if (recipe !== null) return setValues(definition, recipe, { [variable.path]: value });
  const variables = definition.variables.map((one, at) => (at === row ? { ...one, [column]: value } : one));
  if (column !== 'path') return { ...definition, variables };
  const recipes = definition.recipes.map((one) => ({ ...one, values: renamedKey(one.values, variable.path, value) }));
  return { variables, recipes };
}

function renamedKey(values: Recipe['values'], from: string, to: string): Recipe['values'] {
  return Object.fromEntries(Object.entries(values).map(([path, value]) => [path === from ? to : path, value]));
}

/** Values of a recipe, by path; an empty one is taken out. */
export function setValues(
  definition: RecipeDefinition,
  recipe: string,
  values: Readonly<Record<string, string>>,
): RecipeDefinition {
  const recipes = definition.recipes.map((one) =>
    one.name !== recipe
      ? one
      : { ...one, values: Object.fromEntries(Object.entries({ ...one.values, ...values }).filter(([, text]) => text)) },
  );
  return { ...definition, recipes };
}

/** With further variables behind a row; those that are there already are left out. */
interface Offered {
  readonly path: string;
  readonly type: string;
}

/** What can be added, in order: a structure, array or instance stands before its first member that is offered. */
export function offered<Item extends Offered>(
  found: readonly Item[],
  wholes: readonly Item[],
): (Item & { whole: boolean })[] {
  const rest = [...wholes];
  const rows = found.flatMap((item) => {
    const before = rest.filter(({ path }) => item.path.startsWith(`${path}.`) || item.path.startsWith(`${path}[`));
    for (const whole of before) rest.splice(rest.indexOf(whole), 1);
    return [...before.map((whole) => ({ ...whole, whole: true })), { ...item, whole: false }];
  });
  return [...rows, ...rest.map((whole) => ({ ...whole, whole: true }))];
}

export function addVariables(definition: RecipeDefinition, paths: readonly string[], at: number): RecipeDefinition {
  const added: RecipeVariable[] = [];
  for (const path of paths.map((one) => one.trim()))
    if (PATH.test(path) && ![...definition.variables, ...added].some((one) => sameName(one.path, path)))
      added.push({ path, name: '', minimum: '', maximum: '', comment: '' });
  const variables = [...definition.variables.slice(0, at), ...added, ...definition.variables.slice(at)];
  return added.length === 0 ? definition : { ...definition, variables };
}

export function removeVariables(definition: RecipeDefinition, rows: ReadonlySet<number>): RecipeDefinition {
  const gone = new Set(definition.variables.filter((_, at) => rows.has(at)).map(({ path }) => path));
  return {
    variables: definition.variables.filter(({ path }) => !gone.has(path)),
    recipes: definition.recipes.map((recipe) => ({
      ...recipe,
      values: Object.fromEntries(Object.entries(recipe.values).filter(([path]) => !gone.has(path))),
    })),
  };
}

/** Rows moved in front of another one. */
export function moveVariables(
  definition: RecipeDefinition,
  rows: ReadonlySet<number>,
  before: number,
): RecipeDefinition {
  const moved = definition.variables.filter((_, at) => rows.has(at));
  const front = definition.variables.filter((_, at) => !rows.has(at) && at < before);
  const behind = definition.variables.filter((_, at) => !rows.has(at) && at >= before);
  return { ...definition, variables: [...front, ...moved, ...behind] };
}

export function nameFault(definition: RecipeDefinition, name: string, own: string | null): Fault | null {
  const wanted = name.trim();
  // eslint-disable-next-line no-control-regex -- the name is part of that of a file
  if (wanted === '' || wanted.length > 80 || /^\.|[/\\\x00-\x1f]/.test(wanted)) return 'name';
  return definition.recipes.some((one) => one.name !== own && sameName(one.name, wanted)) ? 'nameTaken' : null;
}

export function freeName(definition: RecipeDefinition, base: string): string {
  for (let number = 1; ; number += 1) {
    const name = `${base}${String(number)}`;
    if (nameFault(definition, name, null) === null) return name;
  }
}

/** With another recipe at the end: empty, or with the values of one that is there. */
export function addRecipe(definition: RecipeDefinition, name: string, from: string | null): RecipeDefinition {
  const values = definition.recipes.find((one) => one.name === from)?.values ?? {};
  return { ...definition, recipes: [...definition.recipes, { name: name.trim(), values: { ...values } }] };
}

export function renameRecipe(definition: RecipeDefinition, name: string, to: string): RecipeDefinition {
  return {
    ...definition,
    recipes: definition.recipes.map((one) => (one.name === name ? { ...one, name: to.trim() } : one)),
  };
}

export function removeRecipe(definition: RecipeDefinition, name: string): RecipeDefinition {
  return { ...definition, recipes: definition.recipes.filter((one) => one.name !== name) };
}
