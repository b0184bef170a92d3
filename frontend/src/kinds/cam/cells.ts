/** What the cells of points show and take (CAM-42 to CAM-44, CAM-47). Pure functions. */
import type { TextKey } from '@/i18n';
import { numberText, typedNumber } from '@/editors/form/numbers';
import { FARTHEST, isEnd, roomOf, type CamTable } from './camTable';
import { heldAt } from './consistency';
import type { CamEdit } from './edit';

export type PointColumn = 'x' | 'y' | 'v' | 'a' | 'j';
export const POINT_COLUMNS: readonly PointColumn[] = ['x', 'y', 'v', 'a', 'j'];

/** Why a typed value of a point cannot be taken (CAM-44), or null. */
export function pointFault(cam: CamTable, index: number, name: PointColumn, text: string): TextKey | null {
  const value = typedNumber(text);
  if (!Number.isFinite(value)) return 'cam.fault.number';
  if (Math.abs(value) > FARTHEST) return 'cam.fault.far';
  if (name !== 'x') return null;
  if (isEnd(cam, index)) return value === cam.points[index]!.x ? null : 'cam.fault.end';
  const [least, greatest] = roomOf(cam, index);
  return value >= least && value <= greatest ? null : 'cam.fault.between';
}

/** Why a value of a point cannot be edited: it is computed or given by a segment (CAM-42, CAM-47). */
export function heldReason(cam: CamTable, index: number, name: PointColumn): TextKey | null {
  if (name === 'x' && isEnd(cam, index)) return 'cam.fault.end';
  if (name === 'j') {
    const poly7 = [cam.segments[index - 1], cam.segments[index]].some((one) => one?.law === 'poly7');
    return poly7 ? null : 'cam.held.jerk';
  }
  if ((name === 'v' || name === 'a') && heldAt(cam, index, name) !== null) return 'cam.held.law';
  return null;
}

/** The jerk behind a point: what was typed with Poly7 beside it, else that of the curve. */
export function jerkShown({ cam, drawing }: CamEdit, index: number): number | null {
  if (heldReason(cam, index, 'j') === null) return cam.points[index]!.j;
  if (drawing?.segments.length !== cam.segments.length) return null;
  const behind = drawing.segments[index];
  const value = behind ? behind.j[0] : drawing.segments[index - 1]?.j.at(-1);
  return value === undefined ? null : rounded(value);
}

/** Computed numbers are shown without the noise of their last digits. */
export function rounded(value: number): number {
  return Number(value.toPrecision(7)) + 0;
}

/** The room of X between the neighbours of a point, for messages. */
export function rangeOf(cam: CamTable, index: number): { least: string; greatest: string } {
  return {
    least: numberText(cam.points[Math.max(0, index - 1)]!.x),
    greatest: numberText(cam.points[Math.min(cam.points.length - 1, index + 1)]!.x),
  };
}
