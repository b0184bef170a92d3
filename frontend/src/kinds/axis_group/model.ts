/** Settings of an axis group: what may be entered (axis_group.md, 1). Pure functions. */
import type { Schemas } from '@/api/types';
import type { TextKey } from '@/i18n';

export type GroupSettings = Schemas['AxisGroupSettings'];
export type Dynamics = GroupSettings['limits'];
export type Frame = GroupSettings['pcs_1'];

/** What a page of settings gets. */
export interface GroupPageProps {
  projectId: string;
  objectId: string;
  group: GroupSettings;
  disabled: boolean;
  change: (changes: Partial<GroupSettings>) => void;
}

/** As many as the controller has places for (AG-03). */
export const MOST_AXES = 6;
export const DYNAMICS = ['velocity', 'acceleration', 'deceleration', 'jerk'] as const;
/** Sets of dynamics. */
export const SETS = ['limits', 'defaults', 'jogging'] as const;
export type DynamicsName = (typeof DYNAMICS)[number];
export const COORDINATES = ['x', 'y', 'z', 'a', 'b', 'c'] as const;
export const PRODUCTS = ['pcs_1', 'pcs_2'] as const;

/** A field that can be wrong. */
export type FieldName =
  | `${(typeof SETS)[number]}.${DynamicsName}`
  | `offsets.${number}`
  | `parameters.${string}`
  | `${(typeof PRODUCTS)[number]}.${keyof Frame}`;
export type Faults = Partial<Record<FieldName, TextKey>>;

/** What is wrong with settings, by field. */
export function groupFaults(group: GroupSettings): Faults {
  const faults: Faults = {};
  for (const set of SETS) {
    for (const name of DYNAMICS) {
      const value = group[set][name];
      if (!(Number.isFinite(value) && value >= 0)) faults[`${set}.${name}`] = 'axis.fault.notNegative';
    }
  }
  for (const name of DYNAMICS) {
    const limit = group.limits[name];
    if (limit > 0 && group.defaults[name] > limit) faults[`defaults.${name}`] ??= 'axisGroup.fault.beyondLimit';
  }
  for (const product of PRODUCTS) {
    for (const name of COORDINATES) {
      if (!Number.isFinite(group[product][name])) faults[`${product}.${name}`] = 'axis.fault.number';
    }
  }
  group.kinematics.offsets.forEach((offset, index) => {
    if (!Number.isFinite(offset)) faults[`offsets.${index}`] = 'axis.fault.number';
  });
  for (const [name, value] of Object.entries(group.kinematics.parameters)) {
    if (!Number.isFinite(value)) faults[`parameters.${name}`] = 'axis.fault.number';
  }
  return faults;
}

export function canStore(group: GroupSettings): boolean {
  return Object.keys(groupFaults(group)).length === 0;
}

export interface AxisChoice {
  name: string;
  /** The other group that has the axis, null: none. */
  group: string | null;
}

export interface AxisRow {
  /** The name as the axis has it, or as it is stored where there is no such axis. */
  name: string;
  fault: { text: TextKey; group?: string } | null;
}

const key = (name: string) => name.toUpperCase();

/** The axes of a group by their index, with what is wrong with each: the messages of the build. */
export function axisRows(names: readonly string[], axes: readonly AxisChoice[]): AxisRow[] {
  return names.map((stored, index) => {
    const axis = axes.find((one) => key(one.name) === key(stored));
    const name = axis?.name ?? stored;
    if (stored === '') return { name, fault: { text: 'axisGroup.noAxis' } };
    if (axis === undefined) return { name, fault: { text: 'axisGroup.gone' } };
    if (names.slice(0, index).some((other) => key(other) === key(stored)))
      return { name, fault: { text: 'axisGroup.twice' } };
    if (axis.group !== null) return { name, fault: { text: 'axisGroup.otherGroup', group: axis.group } };
    return { name, fault: null };
  });
}

/** The axis that a new row gets: the first one that no group has, or none. */
export function nextAxis(names: readonly string[], axes: readonly AxisChoice[]): string {
  const taken = new Set(names.map(key));
  return axes.find((axis) => axis.group === null && !taken.has(key(axis.name)))?.name ?? '';
}

/** A list with one place moved by so many places; the same list where it cannot be. */
export function moved<Item>(items: readonly Item[], from: number, by: number): readonly Item[] {
  const to = from + by;
  const item = items[from];
  if (item === undefined || to < 0 || to >= items.length) return items;
  const rest = items.filter((_, index) => index !== from);
  return [...rest.slice(0, to), item, ...rest.slice(to)];
}
