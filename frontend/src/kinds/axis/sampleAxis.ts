/** Settings of an axis for tests: those of a new one. */
import type { SimulatedDrive } from './drive';
import type { AxisSettings } from './model';

export const SAMPLE_DRIVE: SimulatedDrive = {
  motor: {
    inertia: 6e-5,
    viscous: 1e-4,
    dry: 0.01,
    elastic: false,
    load_inertia: 6e-5,
    stiffness: 100,
    damping: 0.001,
  },
  loops: { current_time: 0.0005, position_gain: 60, velocity_gain: 0.03, integral_time: 0.02, feed_forward: 1 },
  encoder: { noise: 0 },
  switches: {
    negative: false,
    negative_at: -10,
    positive: false,
    positive_at: 10,
    home: false,
    home_from: -0.25,
    home_to: 0.25,
  },
  homing: { method: 37, velocity: 10, zero_velocity: 2, acceleration: 1000 },
  limits: { rated_torque: 1.27, max_torque: 3.8, lag: 1, quick_stop: 2000 },
};

export const LIMITS = { velocity: 100, acceleration: 100, deceleration: 100, jerk: 1e5 };

export function sampleAxis(changes: Partial<AxisSettings> = {}): AxisSettings {
  return {
    drive: 'SM_Drive_Virtual',
    axis_type: 'modulo',
    modulo: 360,
    software_limits: { enabled: false, negative: 0, positive: 1000, deceleration: 0 },
    dynamic_limits: LIMITS,
    drive_limits: { velocity: 1e4, acceleration: 1e6, deceleration: 1e6, jerk: 1e8 },
    ramp_type: 'trapez',
    stopping_distance: 0,
    virtual_mode: false,
    position_lag: 0,
    scaling: {
      increments: 65536,
      motor_turns: 1,
      gear_motor_turns: 1,
      gear_output_turns: 1,
      output_turns: 1,
      units: 360,
      invert: false,
    },
    position_control: {
      dead_time: 2,
      gain: 0,
      bits: 32,
      speed_from: 'velocity',
      rated_velocity: 1000,
      rated_raw: 32767,
    },
    mirroring: { master: '', reference: 'set', dead_time: 0, position_filter: 0, velocity_filter: 0 },
    simulated_drive: SAMPLE_DRIVE,
    generic_drive: { rated_torque: 1, bits: 32, dead_time: 2, limit_switches: true },
    mapping: { automatic: true, channels: {} },
    bus_task: '',
    ...changes,
  };
}
