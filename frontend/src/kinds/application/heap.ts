/** The settings of the memory that __NEW takes from: what may be entered. Pure functions. */
import { ofKind } from '@/api/objects';
import type { ProjectObject, Schemas } from '@/api/types';
import type { TextKey } from '@/i18n';

type ApplicationData = Schemas['ApplicationData'];
export type HeapData = Schemas['HeapData'];

/** The server leaves the settings out where they are these. */
export const USUAL_HEAP: HeapData = { limit_kib: 65_536, poison: false };
/** KiB; the bound of the server. */
export const LARGEST_HEAP = 1_048_576;

/** What is wrong with a limit in KiB, or null. */
export function limitFault(limit: number): TextKey | null {
  return Number.isInteger(limit) && limit >= 0 && limit <= LARGEST_HEAP ? null : 'application.heapLimitFault';
}

/** Whether the server takes the data. */
export function canStore(application: ApplicationData): boolean {
  return limitFault((application.heap ?? USUAL_HEAP).limit_kib) === null;
}

/** The same of an object as the project settings have it. */
export function hasUsableHeap(object: ProjectObject): boolean {
  return !ofKind('application')(object) || canStore(object.data);
}
