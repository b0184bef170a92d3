import { describe, expect, it } from 'vitest';
import { axisFaults, beyondDrive, canStore, type AxisSettings } from './model';
import { LIMITS, sampleAxis as axis } from './sampleAxis';
import { unitsPerIncrement } from './scaling';

const scaled = (changes: Partial<AxisSettings['scaling']>) => ({ ...axis().scaling, ...changes });

describe('settings of a drive', () => {
  it('of position control are refused field by field', () => {
    const control = (changes: Partial<AxisSettings['position_control']>) =>
      axisFaults(axis({ position_control: { ...axis().position_control, ...changes } }));
    expect(control({ gain: -1 })).toEqual({ 'control.gain': 'axis.fault.notNegative' });
    expect(control({ dead_time: 255 })).toEqual({ 'control.dead_time': 'axis.fault.deadTime' });
    expect(control({ dead_time: 1.5 })).toEqual({});
    expect(control({ rated_velocity: 0 })).toEqual({ 'control.rated_velocity': 'axis.fault.positive' });
    expect(control({ rated_raw: 1.5 })).toEqual({ 'control.rated_raw': 'axis.fault.count' });
  });

  it('of a logical axis are refused field by field', () => {
    const mirroring = (changes: Partial<AxisSettings['mirroring']>) =>
      axisFaults(axis({ mirroring: { ...axis().mirroring, ...changes } }));
    expect(mirroring({ dead_time: Number.NaN })).toEqual({ 'mirroring.dead_time': 'axis.fault.number' });
    expect(mirroring({ position_filter: 10 })).toEqual({ 'mirroring.position_filter': 'axis.fault.filter' });
    expect(mirroring({ velocity_filter: 0.5 })).toEqual({ 'mirroring.velocity_filter': 'axis.fault.filter' });
    expect(mirroring({ velocity_filter: 9 })).toEqual({});
  });
});

describe('settings of an axis', () => {
  it('are taken as they come', () => {
    expect(axisFaults(axis())).toEqual({});
    expect(canStore(axis())).toBe(true);
  });

  it('are refused field by field', () => {
    expect(axisFaults(axis({ modulo: 0 }))).toEqual({ modulo: 'axis.fault.modulo' });
    expect(axisFaults(axis({ modulo: Number.NaN }))).toEqual({ modulo: 'axis.fault.modulo' });
    expect(axisFaults(axis({ dynamic_limits: { ...LIMITS, velocity: 0 } }))).toEqual({
      'dynamic.velocity': 'axis.fault.positive',
    });
    expect(axisFaults(axis({ drive_limits: { ...LIMITS, jerk: -1 } }))).toEqual({
      'drive.jerk': 'axis.fault.positive',
    });
    expect(axisFaults(axis({ scaling: scaled({ increments: 0, motor_turns: 1.5, units: 0 }) }))).toEqual({
      increments: 'axis.fault.count',
      motor_turns: 'axis.fault.count',
      units: 'axis.fault.positive',
    });
    expect(axisFaults(axis({ stopping_distance: -1 }))).toEqual({ stopping_distance: 'axis.fault.notNegative' });
  });

  it('have a travel range where it is watched', () => {
    const limits = { enabled: true, negative: 5, positive: 5, deceleration: 0 };
    expect(axisFaults(axis({ software_limits: limits }))).toEqual({ positive: 'axis.fault.range' });
    expect(axisFaults(axis({ software_limits: { ...limits, enabled: false } }))).toEqual({});
    expect(axisFaults(axis({ software_limits: { ...limits, negative: Number.NaN } }))).toEqual({
      negative: 'axis.fault.number',
    });
  });

  it('warn of limits that the drive does not reach', () => {
    expect(beyondDrive(axis())).toEqual([]);
    expect(beyondDrive(axis({ dynamic_limits: { ...LIMITS, velocity: 1e5 } }))).toEqual(['velocity']);
  });
});

describe('scaling', () => {
  it('is that of the manual (devices EX-05)', () => {
    expect(unitsPerIncrement(scaled({ increments: 3600, units: 6.283185307 }))).toBeCloseTo(0.001745329, 9);
    expect(1024 * unitsPerIncrement(scaled({ increments: 4096 }))).toBe(90);
    expect(1024 * unitsPerIncrement(scaled({ increments: 4096, invert: true }))).toBe(-90);
    expect(
      unitsPerIncrement(
        scaled({ increments: 1000, gear_motor_turns: 10, gear_output_turns: 3, output_turns: 2, units: 5 }),
      ),
    ).toBeCloseTo(0.00075, 12);
  });
});
