/** The variable that a place found by the search names, as the runtime knows it. */
import { objectQuery, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { rowsInLines } from '@/iec/declaration/lines';
import { parseDeclaration } from '@/iec/declaration/parse';
import { expressionOf, findVariables } from '@/iec/variables';
import { monitorTarget } from '@/project/monitorScope';
import type { SearchHit } from './model';

/**
 * The path of the variable in the line of a hit; null where there is none, or where it has no value of its own: a type,
 * a local variable of a function, a function block without an instance.
 */
export function variableOf(
  objects: readonly ObjectSummary[],
  object: ObjectSummary,
  declaration: string,
  hit: Pick<SearchHit, 'part' | 'line' | 'before' | 'match' | 'after'>,
): string | null {
  const { path, temporary } = monitorTarget(objects, object, null, declaration);
  const model = parseDeclaration(declaration);
  if (hit.part === 'declaration') {
    const [row] = rowsInLines(model, [hit.line]);
    const name = row === undefined ? undefined : model.rows[row]?.name.text;
    return name === undefined || path === null || temporary.has(name.toUpperCase()) ? null : `${path}.${name}`;
  }
  if (hit.part !== 'implementation') return null;
  const members = new Set(model.rows.map((row) => row.name.text.toUpperCase()));
  const [from, to] = [hit.before.length, hit.before.length + hit.match.length];
  const use = findVariables(hit.before + hit.match + hit.after).find(({ start, end }) => start < to && end > from);
  return use === undefined ? null : expressionOf(use.path, { instance: path, members, temporary }, () => null);
}

/** As `variableOf`, with the declaration as the server has it; nothing where it cannot be read. */
export async function variablesOfHit(
  projectId: string,
  objects: readonly ObjectSummary[],
  objectId: string,
  hit: SearchHit,
): Promise<string[]> {
  const object = objects.find(({ id }) => id === objectId);
  if (object === undefined) return [];
  const read = await queryClient.fetchQuery(objectQuery(projectId, objectId)).catch(() => null);
  const declaration = (read?.data as { declaration?: unknown } | undefined)?.declaration;
  const found = variableOf(objects, object, typeof declaration === 'string' ? declaration : '', hit);
  return found === null ? [] : [found];
}
