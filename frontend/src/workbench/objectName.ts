import type { ObjectSummary } from '@/api/types';
import type { t as text } from '@/i18n';

/** Objects whose name is fixed are called in the user's language: the project says `Library Manager` in any. */
const FIXED: ReadonlySet<string> = new Set(['library_manager', 'task_configuration', 'plc_logic']);

export function displayName(object: Pick<ObjectSummary, 'kind' | 'name'>, t: typeof text): string {
  return FIXED.has(object.kind) ? t(`kind.${object.kind}`) : object.name;
}
