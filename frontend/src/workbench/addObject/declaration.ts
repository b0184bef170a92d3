/** Declaration texts of new objects with options that the server's templates do not know. Pure functions. */
import { kindOf, type AddValues, type NewDeclaration } from '@/project/kinds';

/**
 * The declaration for a new object, or null where no option differs from the template and the server's text will do.
 * Options left empty count as not given.
 */
export function declarationOf(kind: string, order: NewDeclaration): string | null {
  const given = Object.entries(order.values).flatMap(([option, value]) =>
    value.trim() ? [[option, value.trim()]] : [],
  );
  const values = Object.fromEntries(given) as AddValues;
  return kindOf(kind)?.add?.declarationOf?.({ ...order, values }) ?? null;
}
