/** Settings of an axis: what may be entered (devices.md, 14.2 and 14.3). Pure functions. */
import type { Schemas } from '@/api/types';
import type { TextKey } from '@/i18n';
import { driveFaults } from './drive';

export type AxisSettings = Schemas['AxisSettings'];
export type Limits = AxisSettings['dynamic_limits'];

/** What a page of settings gets. */
export interface AxisPageProps {
  projectId: string;
  objectId: string;
  axis: AxisSettings;
  disabled: boolean;
  change: (changes: Partial<AxisSettings>) => void;
}

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
  | 'control.gain'
  | 'control.dead_time'
  | 'control.rated_velocity'
  | 'control.rated_raw'
  | 'generic.rated_torque'
  | 'generic.dead_time'
  | 'mirroring.dead_time'
  | 'mirroring.position_filter'
  | 'mirroring.velocity_filter'
  | CountName
  | `dynamic.${LimitName}`
  | `drive.${LimitName}`;

export type Faults = Partial<Record<FieldName, TextKey>>;

const LARGEST_COUNT = 2 ** 31 - 1;
/** Cycles of which the controller keeps set positions. */
const LONGEST_DEAD_TIME = 254;
const DEEPEST_FILTER = 9;

function isWhole(value: number, least: number, most: number): boolean {
  return Number.isInteger(value) && value >= least && value <= most;
}

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
    if (!isWhole(axis.scaling[name], 1, LARGEST_COUNT)) faults[name] = 'axis.fault.count';
  }
  positive('units', axis.scaling.units);
  const control = axis.position_control;
  notNegative('control.gain', control.gain);
  if (!(control.dead_time >= 0 && control.dead_time <= LONGEST_DEAD_TIME)) {
    faults['control.dead_time'] = 'axis.fault.deadTime';
  }
  positive('control.rated_velocity', control.rated_velocity);
  if (!isWhole(control.rated_raw, 1, LARGEST_COUNT)) faults['control.rated_raw'] = 'axis.fault.count';
  const generic = axis.generic_drive;
  positive('generic.rated_torque', generic.rated_torque);
  if (!(generic.dead_time >= 0 && generic.dead_time <= LONGEST_DEAD_TIME)) {
    faults['generic.dead_time'] = 'axis.fault.deadTime';
  }
  if (!Number.isFinite(axis.mirroring.dead_time)) faults['mirroring.dead_time'] = 'axis.fault.number';
  for (const name of ['position_filter', 'velocity_filter'] as const) {
    if (!isWhole(axis.mirroring[name], 0, DEEPEST_FILTER)) faults[`mirroring.${name}`] = 'axis.fault.filter';
  }
  return faults;
}

/** Whether there is something behind the axis that has increments. */
export function hasDrive(axis: AxisSettings): boolean {
  return axis.drive !== 'SM_Drive_Virtual' && axis.drive !== 'SM_Drive_Logical';
}

/** Whether the axis mirrors another one. */
export function isLogical(axis: AxisSettings): boolean {
  return axis.drive === 'SM_Drive_Logical';
}

export function canStore(axis: AxisSettings): boolean {
  const faults = { ...axisFaults(axis), ...driveFaults(axis.simulated_drive) };
  return Object.keys(faults).length === 0;
}

/** Limits of the program that lie above what the drive can do, so that motions with them end in an error. */
export function beyondDrive(axis: AxisSettings): LimitName[] {
  return LIMIT_NAMES.filter((name) => axis.dynamic_limits[name] > axis.drive_limits[name]);
}
