/** Settings of an axis: what may be entered, and the arithmetic of its scaling (devices.md, 14.2 and 14.3). Pure functions. */
import type { Schemas } from '@/api/types';
import type { TextKey } from '@/i18n';

export type AxisSettings = Schemas['AxisSettings'];
export type Scaling = AxisSettings['scaling'];
export type Limits = AxisSettings['dynamic_limits'];

export const LIMIT_NAMES = ['velocity', 'acceleration', 'deceleration', 'jerk'] as const;
export type LimitName = (typeof LIMIT_NAMES)[number];
export const COUNT_NAMES = [
  'increments',
  'motor_turns',
  'gear_motor_turns',
  'gear_output_turns',
  'output_turns',
] as const;
export type CountName = (typeof COUNT_NAMES)[number];

/** A field that can be wrong. */
export type FieldName =
  | 'modulo'
  | 'negative'
  | 'positive'
  | 'limit_deceleration'
  | 'stopping_distance'
  | 'position_lag'
  | 'units'
  | CountName
  | `dynamic.${LimitName}`
  | `drive.${LimitName}`;

export type Faults = Partial<Record<FieldName, TextKey>>;

const LARGEST_COUNT = 2 ** 31 - 1;

/** What is wrong with settings, by field. */
export function axisFaults(axis: AxisSettings): Faults {
  const faults: Faults = {};
  const positive = (field: FieldName, value: number): void => {
    if (!(Number.isFinite(value) && value > 0)) faults[field] = 'axis.fault.positive';
  };
  const notNegative = (field: FieldName, value: number): void => {
    if (!(Number.isFinite(value) && value >= 0)) faults[field] = 'axis.fault.notNegative';
  };
  positive('modulo', axis.modulo);
  if (faults.modulo) faults.modulo = 'axis.fault.modulo';
  const { enabled, negative, positive: upper, deceleration } = axis.software_limits;
  if (!Number.isFinite(negative)) faults.negative = 'axis.fault.number';
  if (!Number.isFinite(upper)) faults.positive = 'axis.fault.number';
  else if (enabled && !faults.negative && negative >= upper) faults.positive = 'axis.fault.range';
  notNegative('limit_deceleration', deceleration);
  notNegative('stopping_distance', axis.stopping_distance);
  notNegative('position_lag', axis.position_lag);
  for (const name of LIMIT_NAMES) {
    positive(`dynamic.${name}`, axis.dynamic_limits[name]);
    positive(`drive.${name}`, axis.drive_limits[name]);
  }
  for (const name of COUNT_NAMES) {
    const count = axis.scaling[name];
    if (!Number.isInteger(count) || count < 1 || count > LARGEST_COUNT) faults[name] = 'axis.fault.count';
  }
  positive('units', axis.scaling.units);
  return faults;
}

/** Whether there is something behind the axis that has increments. */
export function hasDrive(axis: AxisSettings): boolean {
  return axis.drive !== 'SM_Drive_Virtual';
}

export function canStore(axis: AxisSettings): boolean {
  return Object.keys(axisFaults(axis)).length === 0;
}

/** Limits of the program that lie above what the drive can do, so that motions with them end in an error. */
export function beyondDrive(axis: AxisSettings): LimitName[] {
  return LIMIT_NAMES.filter((name) => axis.dynamic_limits[name] > axis.drive_limits[name]);
}

/** Units of the application for one increment, with the sign of the direction. */
export function unitsPerIncrement(scaling: Scaling): number {
  const turns = (scaling.motor_turns / scaling.increments) * (scaling.gear_output_turns / scaling.gear_motor_turns);
  return (turns * scaling.units * (scaling.invert ? -1 : 1)) / scaling.output_turns;
}
