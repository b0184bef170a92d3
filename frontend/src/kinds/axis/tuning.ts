/** Tuning of a position loop: what was measured, and what of it can be written where. Pure functions. */
import type { Schemas } from '@/api/types';
import type { TextKey } from '@/i18n';
import { numberText } from '@/editors/form/numbers';
import type { Range } from '@/editors/plot/scales';
import type { AxisSettings } from './model';

export type Tuning = Schemas['AxisTuning'];
export type Measured = Schemas['AxisMeasured'];
export type Proposal = Measured['proposals'][number];
export type Aim = Proposal['aim'];
export type GainName = Tuning['gains'][number]['name'];
export type Excitation = Tuning['excitation'];

export const AIMS: readonly Aim[] = ['no_overshoot', 'fast'];
export const LONGEST_S = 10;

export const GAIN_UNITS: Readonly<Record<GainName, string>> = {
  position_gain: '1/s',
  dead_time: '',
  velocity_gain: 'Nms',
  integral_time: 's',
};

/** A gain with its present value and the proposed one. */
export interface GainRow {
  name: GainName;
  expression: string;
  present: number;
  proposed: number | null;
}

export function gainRows(tuning: Tuning, proposal: Proposal | null): GainRow[] {
  return tuning.gains.map(({ name, expression, value }) => ({
    name,
    expression,
    present: value,
    proposed: proposal?.gains.find((gain) => gain.name === name)?.value ?? null,
  }));
}

/** Four digits are more than any of these numbers is good for. */
export function shown(value: number, digits = 4): string {
  return numberText(Number(value.toPrecision(digits)));
}

/** A proposed value as it is written: what is shown is what is there then. */
export function writtenValue(value: number): number {
  return Number(value.toPrecision(4));
}

/** The settings with the proposed gains; null where the project does not keep them. */
export function withGains(axis: AxisSettings, proposal: Proposal): AxisSettings | null {
  const value = (name: GainName, before: number) => {
    const found = proposal.gains.find((gain) => gain.name === name);
    return found === undefined ? before : writtenValue(found.value);
  };
  if (axis.drive === 'SM_Drive_PosControl') {
    const { position_control: control } = axis;
    const [gain, dead_time] = [value('position_gain', control.gain), value('dead_time', control.dead_time)];
    return { ...axis, position_control: { ...control, gain, dead_time } };
  }
  if (axis.drive !== 'SM_Drive_Simulated') return null;
  const { loops } = axis.simulated_drive;
  return {
    ...axis,
    simulated_drive: {
      ...axis.simulated_drive,
      loops: {
        ...loops,
        position_gain: value('position_gain', loops.position_gain),
        velocity_gain: value('velocity_gain', loops.velocity_gain),
        integral_time: value('integral_time', loops.integral_time),
      },
    },
  };
}

/** Whether an axis has a position loop that can be tuned here. */
export function isTunable(axis: AxisSettings): boolean {
  return (axis.drive === 'SM_Drive_PosControl' || axis.drive === 'SM_Drive_Simulated') && !axis.virtual_mode;
}

export function heightFault(height: number): TextKey | null {
  return Number.isFinite(height) && height !== 0 ? null : 'axis.tuning.heightFault';
}

export function durationFault(seconds: number): TextKey | null {
  return seconds > 0 && seconds <= LONGEST_S ? null : 'axis.tuning.durationFault';
}

/** The range of several curves with some room above and below; 0 is in it. */
export function rangeOf(curves: readonly (readonly number[])[]): Range {
  let [min, max] = [0, 0];
  for (const curve of curves) for (const value of curve) [min, max] = [Math.min(min, value), Math.max(max, value)];
  if (max - min < 1e-12) return { min: -1, max: 1 };
  const room = 0.08 * (max - min);
  return { min: min - room, max: max + room };
}

/** The sample that is nearest to a time; samples are evenly spread. */
export function sampleAt(time: readonly number[], at: number): number {
  const [first, last] = [time[0] ?? 0, time.at(-1) ?? 0];
  if (!(last > first)) return 0;
  const index = Math.round(((at - first) / (last - first)) * (time.length - 1));
  return Math.max(0, Math.min(time.length - 1, index));
}
