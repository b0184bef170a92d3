/** The memory that a download sets aside for online changes: what may be entered. Pure functions. */
import { ofKind } from '@/api/objects';
import type { ProjectObject, Schemas } from '@/api/types';
import type { TextKey } from '@/i18n';

type ApplicationData = Schemas['ApplicationData'];
export type ReserveData = Schemas['ChangeReserveData'];

/** The server leaves the settings out where they are these. */
export const USUAL_RESERVE: ReserveData = { percent: 100, least_kib: 1024 };
export const LARGEST_PERCENT = 1000;
/** KiB; the bound of the server. */
export const LARGEST_RESERVE = 1_048_576;

const within = (value: number, most: number) => Number.isInteger(value) && value >= 0 && value <= most;

export function percentFault(percent: number): TextKey | null {
  return within(percent, LARGEST_PERCENT) ? null : 'application.reservePercentFault';
}

export function leastFault(kib: number): TextKey | null {
  return within(kib, LARGEST_RESERVE) ? null : 'application.reserveLeastFault';
}

/** Whether the server takes the settings. */
export function usableReserve(application: ApplicationData): boolean {
  const { percent, least_kib } = application.change_reserve ?? USUAL_RESERVE;
  return percentFault(percent) === null && leastFault(least_kib) === null;
}

/** The same of an object as the project settings have it. */
export function hasUsableReserve(object: ProjectObject): boolean {
  return !ofKind('application')(object) || usableReserve(object.data);
}
