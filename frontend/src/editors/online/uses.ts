/** Where the variables stand whose values are shown, in a body and in a declaration. Pure functions. */
import { parseDeclaration } from '@/iec/declaration/parse';
import { findVariables, type VariableUse } from '@/iec/variables';
import type { Part } from '@/project/partUri';
import { valueTokens } from '@/text/bodies';

export const usesOf: Record<Part, (text: string) => readonly VariableUse[]> = {
  implementation: (text) => findVariables(text, valueTokens(text)),
  declaration: declaredUses,
};

/** The names that a text declares. A member of a structure and a value of an enumeration have no place of their own. */
function declaredUses(text: string): VariableUse[] {
  const { rows, blocks } = parseDeclaration(text);
  return rows.flatMap(({ name, block, special }): VariableUse[] => {
    const { frame, scope } = blocks[block] ?? {};
    if (special !== null || frame !== 'variables') return [];
    const root = scope === 'VAR_EXTERNAL' ? 'global' : 'own';
    return [{ start: name.start, end: name.end, path: { root, parts: [{ kind: 'name', name: name.text }] } }];
  });
}
