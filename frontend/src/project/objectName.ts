import type { ObjectSummary } from '@/api/types';
import { kindOf, kindTitle } from './kinds';

/** Objects whose name is fixed are called in the user's language: the project says `Library Manager` in any. */
export function displayName(object: Pick<ObjectSummary, 'kind' | 'name'>): string {
  return kindOf(object.kind)?.tree?.fixedName ? kindTitle(object.kind) : object.name;
}
