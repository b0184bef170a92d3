import type { ObjectKindDescriptor } from '@/project/kinds';
import type { Part } from '@/project/partUri';
import { onDemand } from '@/ui/onDemand';

interface TextKind extends Omit<ObjectKindDescriptor, 'editor' | 'compiled'> {
  parts: readonly Part[];
}

/** A kind whose objects are texts: the compiler gets them, and they open in the editor of texts. */
export function textKind(own: TextKind): ObjectKindDescriptor {
  return { ...own, editor: onDemand(() => import('./TextObjectEditor')), compiled: true };
}
