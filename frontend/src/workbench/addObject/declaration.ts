/** Declaration texts of new objects with options that the server's templates do not know. Pure functions. */
import type { ObjectKind } from '@/api/types';

export interface ObjectOptions {
  extends?: string;
  implements?: string;
  /** Type that a function or method answers, or of a property. */
  returns?: string;
  access?: 'PUBLIC' | 'PRIVATE' | 'PROTECTED' | 'INTERNAL';
  /** Type that an alias or subrange is made from. */
  base?: string;
}

/**
 * The declaration for a new object, or null where no option differs from the template and the server's text will do.
 * Options left empty count as not given.
 */
export function declarationOf(
  kind: ObjectKind,
  subkind: string | undefined,
  name: string,
  options: ObjectOptions,
): string | null {
  const base = options.extends?.trim();
  const interfaces = options.implements?.trim();
  const returns = options.returns?.trim();
  const heritage = `${base ? ` EXTENDS ${base}` : ''}${interfaces ? ` IMPLEMENTS ${interfaces}` : ''}`;
  const access = options.access && options.access !== 'PUBLIC' ? `${options.access} ` : '';
  switch (kind) {
    case 'pou':
      if (subkind === 'function_block' && heritage) {
        return `FUNCTION_BLOCK ${name}${heritage}\nVAR_INPUT\nEND_VAR\nVAR_OUTPUT\nEND_VAR\nVAR\nEND_VAR`;
      }
      if (subkind === 'function' && returns) return `FUNCTION ${name} : ${returns}\nVAR_INPUT\nEND_VAR\nVAR\nEND_VAR`;
      return null;
    case 'interface':
      return base ? `INTERFACE ${name} EXTENDS ${base}` : null;
    case 'method':
      return `METHOD ${access}${name}${returns ? ` : ${returns}` : ''}\nVAR_INPUT\nEND_VAR`;
    case 'property':
      return returns || access ? `PROPERTY ${access}${name} : ${returns || 'BOOL'}` : null;
    case 'dut':
      if (subkind === 'struct' && base) return `TYPE ${name} EXTENDS ${base} :\nSTRUCT\nEND_STRUCT\nEND_TYPE`;
      if (subkind === 'alias' && options.base?.trim()) return `TYPE ${name} : ${options.base.trim()};\nEND_TYPE`;
      return null;
    default:
      return null;
  }
}

/** Which options the dialog shows for a kind. */
export function optionsOf(kind: ObjectKind, subkind: string | undefined): readonly (keyof ObjectOptions)[] {
  switch (kind) {
    case 'pou':
      if (subkind === 'function_block') return ['extends', 'implements'];
      return subkind === 'function' ? ['returns'] : [];
    case 'interface':
      return ['extends'];
    case 'method':
    case 'property':
      return ['returns', 'access'];
    case 'dut':
      if (subkind === 'struct') return ['extends'];
      return subkind === 'alias' ? ['base'] : [];
    default:
      return [];
  }
}
