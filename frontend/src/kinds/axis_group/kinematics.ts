/** The kinematics of the library and their parameters. Pure functions. */
import table from './kinematics.json';
import type { GroupSettings } from './model';

export type Kinematics = GroupSettings['kinematics'];
export type KinematicsType = Kinematics['type'];

export interface KinematicsForm {
  /** How many axes of the group it moves. */
  axes: number;
  /** `stArm.fA1` is a member of one. */
  parameters: readonly string[];
}

const FORMS: Readonly<Record<string, KinematicsForm>> = table;
/** All of them, the simplest first. */
export const TYPES = Object.keys(table) as Exclude<KinematicsType, ''>[];

export function formOf(type: KinematicsType): KinematicsForm | null {
  return FORMS[type] ?? null;
}

/** Whether a parameter is a BOOL; 0 is FALSE. */
export function isFlag(parameter: string): boolean {
  return /(^|\.)x[A-Z]/.test(parameter);
}

/** The unit of a parameter: an angle, or a length. */
export function unitOf(parameter: string): string {
  return /RotationOffset|Angle/.test(parameter) ? '°' : 'u';
}

/** Another kinematics, with the parameters that both have. */
export function withType(kinematics: Kinematics, type: KinematicsType): Kinematics {
  const known = formOf(type)?.parameters ?? [];
  const parameters = Object.fromEntries(Object.entries(kinematics.parameters).filter(([name]) => known.includes(name)));
  return { ...kinematics, type, parameters };
}
