import type { ObjectKind } from '@/api/types';
import type { Part } from '../documents/documents';

/** Which text parts an object of this kind has, as its editor shows them. */
export function partsShown(kind: ObjectKind): readonly Part[] {
  switch (kind) {
    case 'pou':
    case 'method':
    case 'accessor':
      return ['declaration', 'implementation'];
    case 'action':
      // An action has no variables of its own (LDEC-126); its first line is its name.
      return ['implementation'];
    default:
      return ['declaration'];
  }
}
