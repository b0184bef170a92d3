import { describe, expect, it } from 'vitest';
import type { AxisSettings } from './model';
import {
  durationFault,
  gainRows,
  heightFault,
  rangeOf,
  sampleAt,
  withGains,
  type Proposal,
  type Tuning,
} from './tuning';

const proposal: Proposal = {
  aim: 'fast',
  gains: [
    { name: 'position_gain', value: 31.41592653 },
    { name: 'dead_time', value: 6 },
  ],
  phase_margin_deg: 61,
  gain_margin: 3.1,
  answer: [],
};
const tuning = {
  gains: [
    { name: 'position_gain', expression: 'IoConfig_Globals.Axis.fKp', value: 5 },
    { name: 'dead_time', expression: 'IoConfig_Globals.Axis.fDeadTimeCycles', value: 2 },
  ],
} as Tuning;

describe('gains', () => {
  it('stand beside those of the controller', () => {
    expect(gainRows(tuning, proposal).map((row) => [row.name, row.present, row.proposed])).toEqual([
      ['position_gain', 5, 31.41592653],
      ['dead_time', 2, 6],
    ]);
    expect(gainRows(tuning, null).map((row) => row.proposed)).toEqual([null, null]);
  });

  it('are taken into the settings of a position controlled drive with the digits that are shown', () => {
    const axis = {
      drive: 'SM_Drive_PosControl',
      position_control: { gain: 0, dead_time: 2, bits: 32 },
    } as AxisSettings;
    expect(withGains(axis, proposal)?.position_control).toEqual({ gain: 31.42, dead_time: 6, bits: 32 });
    expect(axis.position_control.gain).toBe(0);
    expect(withGains({ ...axis, drive: 'SM_Drive_Virtual' }, proposal)).toBeNull();
  });

  it('are taken into the loops of a simulated drive', () => {
    const loops = {
      current_time: 0.0005,
      position_gain: 60,
      velocity_gain: 0.03,
      integral_time: 0.02,
      feed_forward: 1,
    };
    const axis = { drive: 'SM_Drive_Simulated', simulated_drive: { loops } } as AxisSettings;
    const gains: Proposal['gains'] = [
      { name: 'position_gain', value: 166.666 },
      { name: 'velocity_gain', value: 0.0439629 },
      { name: 'integral_time', value: 0.0045 },
    ];
    expect(withGains(axis, { ...proposal, gains })?.simulated_drive.loops).toEqual({
      ...loops,
      position_gain: 166.7,
      velocity_gain: 0.04396,
      integral_time: 0.0045,
    });
  });
});

describe('what is entered', () => {
  it('is a height that is a step', () => {
    expect([1, -0.5, 0, NaN].map(heightFault)).toEqual([
      null,
      null,
      'axis.tuning.heightFault',
      'axis.tuning.heightFault',
    ]);
  });

  it('is a duration that the controller takes', () => {
    expect([0.1, 10, 0, 10.1, NaN].map((seconds) => durationFault(seconds) === null)).toEqual([
      true,
      true,
      false,
      false,
      false,
    ]);
  });
});

describe('the plot', () => {
  it('has room around all curves, and 0 in it', () => {
    expect(rangeOf([[1, 2], [5]])).toEqual({ min: -0.4, max: 5.4 });
    expect(rangeOf([[0, 0]])).toEqual({ min: -1, max: 1 });
  });

  it('finds the sample below the pointer', () => {
    const time = [-0.2, -0.1, 0, 0.1, 0.2];
    expect([-1, -0.16, 0.04, 0.06, 9].map((at) => sampleAt(time, at))).toEqual([0, 0, 2, 3, 4]);
  });
});
