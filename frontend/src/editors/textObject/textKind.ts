import { lazy } from 'react';
import type { ObjectKindDescriptor } from '@/project/kinds';
import type { Part } from '@/project/partUri';

interface TextKind extends Omit<ObjectKindDescriptor, 'editor' | 'compiled'> {
  parts: readonly Part[];
}

/** A kind whose objects are texts: the compiler gets them, and they open in the editor of texts. */
export function textKind(own: TextKind): ObjectKindDescriptor {
  return { ...own, editor: lazy(() => import('./TextObjectEditor')), compiled: true };
}
