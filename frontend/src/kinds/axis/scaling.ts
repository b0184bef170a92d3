/** The arithmetic of the scaling of an axis (devices.md, 14.3). Pure functions. */
import type { Schemas } from '@/api/types';

export type Scaling = Schemas['AxisSettings']['scaling'];

/** Units of the application for one increment, with the sign of the direction. */
export function unitsPerIncrement(scaling: Scaling): number {
  const turns = (scaling.motor_turns / scaling.increments) * (scaling.gear_output_turns / scaling.gear_motor_turns);
  return (turns * scaling.units * (scaling.invert ? -1 : 1)) / scaling.output_turns;
}

/** Increments of the encoder for a turn of the motor. */
export function incrementsOfTurn({ increments, motor_turns }: Scaling): number {
  return Math.max(1, Math.round(increments / motor_turns));
}

/** Turns of the motor in units of the axis, counted from where it stands at the start. */
export function unitsOfTurns(turns: number, scaling: Scaling): number {
  return turns * incrementsOfTurn(scaling) * unitsPerIncrement(scaling);
}
