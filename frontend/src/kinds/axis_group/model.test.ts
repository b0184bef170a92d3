import { describe, expect, it } from 'vitest';
import { axisRows, canStore, groupFaults, moved, nextAxis, type GroupSettings } from './model';
import { formOf, isFlag, withType } from './kinematics';
import { blockName, remaining, slotsOf } from './queue';

const NOTHING = { velocity: 0, acceleration: 0, deceleration: 0, jerk: 0 };
const ORIGIN = { x: 0, y: 0, z: 0, a: 0, b: 0, c: 0 };
const NEW: GroupSettings = {
  axes: [],
  kinematics: { type: '', offsets: [0, 0, 0, 0, 0, 0], parameters: {} },
  limits: NOTHING,
  defaults: NOTHING,
  jogging: NOTHING,
  pcs_1: ORIGIN,
  pcs_2: ORIGIN,
};
const AXES = [
  { name: 'X', group: null },
  { name: 'Y', group: null },
  { name: 'Z', group: 'Other' },
];

describe('settings of an axis group', () => {
  it('takes those of a new one', () => {
    expect(groupFaults(NEW)).toEqual({});
    expect(canStore(NEW)).toBe(true);
  });

  it('names what is wrong by field', () => {
    const group = {
      ...NEW,
      limits: { ...NOTHING, velocity: -1, jerk: 10 },
      defaults: { ...NOTHING, velocity: 5, jerk: 11 },
      pcs_2: { ...ORIGIN, b: Number.NaN },
      kinematics: { type: 'Kin_Scara2_Z' as const, offsets: [0, Number.NaN], parameters: { dArmLength1: Number.NaN } },
    };
    expect(groupFaults(group)).toEqual({
      'limits.velocity': 'axis.fault.notNegative',
      'defaults.jerk': 'axisGroup.fault.beyondLimit',
      'pcs_2.b': 'axis.fault.number',
      'offsets.1': 'axis.fault.number',
      'parameters.dArmLength1': 'axis.fault.number',
    });
    expect(canStore(group)).toBe(false);
  });
});

describe('rows of axes', () => {
  it('say what the build would say', () => {
    const faults = axisRows(['x', '', 'Gone', 'X', 'Z'], AXES).map((row) => row.fault?.text ?? null);
    expect(faults).toEqual([null, 'axisGroup.noAxis', 'axisGroup.gone', 'axisGroup.twice', 'axisGroup.otherGroup']);
  });

  it('show an axis as it is written', () => {
    expect(axisRows(['x'], AXES)[0]?.name).toBe('X');
  });

  it('begin with the first axis that is free', () => {
    expect(nextAxis([], AXES)).toBe('X');
    expect(nextAxis(['x'], AXES)).toBe('Y');
    expect(nextAxis(['X', 'Y'], AXES)).toBe('');
  });

  it('move, and stay at the ends', () => {
    expect(moved(['a', 'b', 'c'], 0, 1)).toEqual(['b', 'a', 'c']);
    expect(moved(['a', 'b', 'c'], 2, -1)).toEqual(['a', 'c', 'b']);
    expect(moved(['a', 'b'], 1, 1)).toEqual(['a', 'b']);
    expect(moved(['a', 'b'], 0, -1)).toEqual(['a', 'b']);
  });
});

describe('a kinematics', () => {
  it('keeps the parameters that the next one has, too', () => {
    const parameters = { dArmLength1: 3, dArmLength3: 5 };
    const scara = { type: 'Kin_Scara3_Z' as const, offsets: [1, 0, 0, 0, 0, 0], parameters };
    expect(withType(scara, 'Kin_Scara2_Z')).toEqual({ ...scara, type: 'Kin_Scara2_Z', parameters: { dArmLength1: 3 } });
    expect(withType(scara, '')).toEqual({ ...scara, type: '', parameters: {} });
  });

  it('has a form by the library', () => {
    expect(formOf('Kin_Gantry3')).toEqual({ axes: 3, parameters: [] });
    expect(formOf('')).toBeNull();
    expect(isFlag('stArm.xZUp')).toBe(true);
    expect(isFlag('dArmLength1')).toBe(false);
  });
});

describe('the information queue', () => {
  it('begins with the running command and goes around the ring', () => {
    expect(slotsOf(62, 4)).toEqual([62, 63, 0, 1]);
    expect(slotsOf(5, 0)).toEqual([]);
  });

  it('names blocks by their codes', () => {
    expect(blockName(0xaaaa)).toBe('MC_MoveLinearAbsolute');
    expect(blockName(0x0b)).toBe('16#000B');
  });

  it('has the whole path of what waits left', () => {
    expect(remaining(100, 30, true)).toBe(70);
    expect(remaining(100, 30, false)).toBe(100);
    expect(remaining(100, 100.5, true)).toBe(0);
  });
});
