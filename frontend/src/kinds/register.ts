/** The folders of the kinds, found by their place: a new kind is a new folder beside this file. */
import { registerKind, type ObjectKindDescriptor } from '@/project/kinds';

const DESCRIPTORS = import.meta.glob<ObjectKindDescriptor>('./*/index.tsx', { eager: true, import: 'default' });

export function registerKinds(descriptors: Readonly<Record<string, ObjectKindDescriptor>> = DESCRIPTORS): void {
  Object.values(descriptors).forEach(registerKind);
}
