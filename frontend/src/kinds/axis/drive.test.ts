import { describe, expect, it } from 'vitest';
import en from './en.json';
import zh from './zh.json';
import {
  DRIVE_NUMBERS,
  driveFaults,
  eigenfrequencies,
  HOMING_METHODS,
  homingWay,
  missingSwitches,
  neededSwitches,
  type GroupName,
  type SimulatedDrive,
} from './drive';
import { canStore } from './model';
import { SAMPLE_DRIVE, sampleAxis } from './sampleAxis';
import { incrementsOfTurn, unitsOfTurns } from './scaling';

const changed = <Group extends GroupName>(group: Group, changes: Partial<SimulatedDrive[Group]>): SimulatedDrive => ({
  ...SAMPLE_DRIVE,
  [group]: { ...SAMPLE_DRIVE[group], ...changes },
});

describe('settings of a simulated drive', () => {
  it('are taken as they come', () => {
    expect(driveFaults(SAMPLE_DRIVE)).toEqual({});
  });

  it('are refused field by field', () => {
    expect(driveFaults(changed('motor', { inertia: 0, dry: -1, stiffness: Number.NaN }))).toEqual({
      'motor.inertia': 'axis.fault.positive',
      'motor.dry': 'axis.fault.notNegative',
      'motor.stiffness': 'axis.fault.positive',
    });
    expect(driveFaults(changed('loops', { feed_forward: 1.1 }))).toEqual({
      'loops.feed_forward': 'axis.fault.fraction',
    });
    expect(driveFaults(changed('switches', { home_to: Number.NaN }))).toEqual({
      'switches.home_to': 'axis.fault.number',
    });
    const wrong = changed('limits', { quick_stop: 0 });
    expect(canStore(sampleAxis({ simulated_drive: wrong }))).toBe(false);
  });

  it('have switches in order, where there are switches', () => {
    const limits = { negative: true, negative_at: 3, positive: true, positive_at: 3 };
    expect(driveFaults(changed('switches', limits))).toEqual({ 'switches.positive_at': 'axis.fault.limitSwitches' });
    expect(driveFaults(changed('switches', { ...limits, negative: false }))).toEqual({});
    const home = { home: true, home_from: 1, home_to: 0.5 };
    expect(driveFaults(changed('switches', home))).toEqual({ 'switches.home_to': 'axis.fault.homeSwitch' });
    expect(driveFaults(changed('switches', { ...home, home: false }))).toEqual({});
  });

  it('have a text for each number, in both languages', () => {
    for (const [group, numbers] of Object.entries(DRIVE_NUMBERS))
      for (const name of Object.keys(numbers))
        for (const texts of [en, zh]) expect(texts).toHaveProperty([`axis.drive.${group}.${name}`]);
  });
});

describe('homing methods', () => {
  it('of one way have one text', () => {
    expect(homingWay(7)).toEqual({ way: 7, pulse: true });
    expect(homingWay(23)).toEqual({ way: 7, pulse: false });
    expect(homingWay(34)).toEqual({ way: 34, pulse: false });
    for (const method of HOMING_METHODS)
      for (const texts of [en, zh]) expect(texts).toHaveProperty([`axis.method.${homingWay(method).way}`]);
  });

  it('need the switches of their diagrams', () => {
    expect(neededSwitches(17)).toEqual(['negative']);
    expect(neededSwitches(2)).toEqual(['positive']);
    expect(neededSwitches(22)).toEqual(['home']);
    expect(neededSwitches(26)).toEqual(['home', 'positive']);
    expect(neededSwitches(11)).toEqual(['home', 'negative']);
    expect([33, 34, 35, 37].flatMap((method) => neededSwitches(method as 33))).toEqual([]);
    const drive = changed('homing', { method: 7 });
    expect(missingSwitches(drive)).toEqual(['home', 'positive']);
    expect(missingSwitches({ ...drive, switches: { ...drive.switches, home: true } })).toEqual(['positive']);
  });
});

describe('an elastic shaft', () => {
  it('has the eigenfrequencies of its closed form', () => {
    const [free, held] = eigenfrequencies({ ...SAMPLE_DRIVE.motor, inertia: 1e-3, load_inertia: 1e-3, stiffness: 5 });
    expect(free).toBeCloseTo(100 / (2 * Math.PI), 9);
    expect(held).toBeCloseTo(Math.sqrt(5000) / (2 * Math.PI), 9);
  });
});

describe('places of the motor', () => {
  it('are shown in units', () => {
    const { scaling } = sampleAxis();
    expect(incrementsOfTurn({ ...scaling, increments: 1000, motor_turns: 3 })).toBe(333);
    expect(unitsOfTurns(2, { ...scaling, units: 10, invert: true })).toBeCloseTo(-20, 12);
  });
});
