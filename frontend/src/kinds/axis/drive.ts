/** Settings of a simulated drive: what may be entered, and what its homing method needs. Pure functions. */
import type { Schemas } from '@/api/types';
import type { TextKey } from '@/i18n';

export type SimulatedDrive = Schemas['SimulatedDrive'];
export type HomingMethod = SimulatedDrive['homing']['method'];
export type GroupName = keyof SimulatedDrive;

type Rule = 'positive' | 'notNegative' | 'number' | 'fraction';

/** The numbers of each group, with their units and what they may be. */
export const DRIVE_NUMBERS = {
  motor: {
    inertia: { unit: 'kgm²', rule: 'positive' },
    viscous: { unit: 'Nms', rule: 'notNegative' },
    dry: { unit: 'Nm', rule: 'notNegative' },
    load_inertia: { unit: 'kgm²', rule: 'positive' },
    stiffness: { unit: 'Nm/rad', rule: 'positive' },
    damping: { unit: 'Nms/rad', rule: 'notNegative' },
  },
  loops: {
    current_time: { unit: 's', rule: 'notNegative' },
    position_gain: { unit: '1/s', rule: 'notNegative' },
    velocity_gain: { unit: 'Nms', rule: 'notNegative' },
    integral_time: { unit: 's', rule: 'notNegative' },
    feed_forward: { unit: '', rule: 'fraction' },
  },
  encoder: { noise: { unit: 'inc', rule: 'notNegative' } },
  switches: {
    negative_at: { unit: 'turns', rule: 'number' },
    positive_at: { unit: 'turns', rule: 'number' },
    home_from: { unit: 'turns', rule: 'number' },
    home_to: { unit: 'turns', rule: 'number' },
  },
  homing: {
    velocity: { unit: 'rad/s', rule: 'positive' },
    zero_velocity: { unit: 'rad/s', rule: 'positive' },
    acceleration: { unit: 'rad/s²', rule: 'notNegative' },
  },
  limits: {
    rated_torque: { unit: 'Nm', rule: 'positive' },
    max_torque: { unit: 'Nm', rule: 'positive' },
    lag: { unit: 'turns', rule: 'notNegative' },
    quick_stop: { unit: 'rad/s²', rule: 'positive' },
  },
} as const satisfies Record<GroupName, Record<string, { unit: string; rule: Rule }>>;

type Numbers = typeof DRIVE_NUMBERS;
export type DriveField = { [Group in GroupName]: `${Group}.${keyof Numbers[Group] & string}` }[GroupName];
export type DriveFaults = Partial<Record<DriveField, TextKey>>;

const RULES: Record<Rule, { holds: (value: number) => boolean; text: TextKey }> = {
  positive: { holds: (value) => Number.isFinite(value) && value > 0, text: 'axis.fault.positive' },
  notNegative: { holds: (value) => Number.isFinite(value) && value >= 0, text: 'axis.fault.notNegative' },
  number: { holds: Number.isFinite, text: 'axis.fault.number' },
  fraction: { holds: (value) => value >= 0 && value <= 1, text: 'axis.fault.fraction' },
};

/** What is wrong with the settings of a drive, by field. */
export function driveFaults(drive: SimulatedDrive): DriveFaults {
  const faults: DriveFaults = {};
  for (const group of Object.keys(DRIVE_NUMBERS) as GroupName[]) {
    const numbers: Record<string, { rule: Rule }> = DRIVE_NUMBERS[group];
    const values = drive[group] as Record<string, unknown>;
    for (const [name, { rule }] of Object.entries(numbers)) {
      const { holds, text } = RULES[rule];
      if (!holds(values[name] as number)) faults[`${group}.${name}` as DriveField] = text;
    }
  }
  const { switches } = drive;
  if (switches.negative && switches.positive && switches.negative_at >= switches.positive_at)
    faults['switches.positive_at'] ??= 'axis.fault.limitSwitches';
  if (switches.home && switches.home_from > switches.home_to) faults['switches.home_to'] ??= 'axis.fault.homeSwitch';
  return faults;
}

/** The methods of a simulated drive (object 6098h). */
export const HOMING_METHODS: readonly HomingMethod[] = [
  ...[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14],
  ...[17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 33, 34, 35, 37],
] as HomingMethod[];

/** The method of the same way that goes on to an index pulse, and whether this one does. */
export function homingWay(method: HomingMethod): { way: HomingMethod; pulse: boolean } {
  if (method >= 17 && method <= 30) return { way: (method - 16) as HomingMethod, pulse: false };
  return { way: method, pulse: method <= 14 };
}

export type SwitchName = 'negative' | 'positive' | 'home';

/** The switches that a method looks for or turns at. */
export function neededSwitches(method: HomingMethod): SwitchName[] {
  const { way } = homingWay(method);
  if (way === 1) return ['negative'];
  if (way === 2) return ['positive'];
  if (way <= 6) return ['home'];
  if (way <= 10) return ['home', 'positive'];
  return way <= 14 ? ['home', 'negative'] : [];
}

/** Those that the drive does not have, so that homing fails. */
export function missingSwitches(drive: SimulatedDrive): SwitchName[] {
  return neededSwitches(drive.homing.method).filter((name) => !drive.switches[name]);
}

/** The eigenfrequencies of the elastic shaft, free and with the motor held [Hz]. */
export function eigenfrequencies({ inertia, load_inertia, stiffness }: SimulatedDrive['motor']): [number, number] {
  const hertz = (inverse: number) => Math.sqrt(stiffness * inverse) / (2 * Math.PI);
  return [hertz(1 / inertia + 1 / load_inertia), hertz(1 / load_inertia)];
}
