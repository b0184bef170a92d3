import { describe, expect, it } from 'vitest';
import { fits, valueOf, withInstance, withValues, type PathBlock } from './blocks';

const SMOOTH: PathBlock = {
  name: 'SMC_SmoothPath',
  comment: '',
  parameters: [
    { name: 'dEdgeDistance', type: 'LREAL', initial: '0', comment: '', values: [] },
    { name: 'bSymmetricalDistances', type: 'BOOL', initial: 'TRUE', comment: '', values: ['FALSE', 'TRUE'] },
    { name: 'wAddAxis', type: 'WORD', initial: '7', comment: '', values: [] },
  ],
};
const [distance, symmetric, axes] = SMOOTH.parameters as [
  PathBlock['parameters'][number],
  PathBlock['parameters'][number],
  PathBlock['parameters'][number],
];

describe('the chain of preprocessing blocks', () => {
  it('takes a block several times, behind the chosen one (CNCS-03, CNCS-04)', () => {
    const one = withInstance([], 'SMC_RoundPath', -1);
    const two = withInstance(one, 'SMC_SmoothPath', 0);
    const three = withInstance(two, 'SMC_RoundPath', 0);
    expect(three.map(({ block }) => block)).toEqual(['SMC_RoundPath', 'SMC_RoundPath', 'SMC_SmoothPath']);
  });

  it('keeps only the values that are not the initial ones (CNCS-09)', () => {
    const instance = withValues(SMOOTH, { dEdgeDistance: '2.5', bSymmetricalDistances: 'TRUE', wAddAxis: '7' });
    expect(instance).toEqual({ block: 'SMC_SmoothPath', parameters: [{ name: 'dEdgeDistance', value: '2.5' }] });
    expect([valueOf(instance, distance), valueOf(instance, symmetric)]).toEqual(['2.5', 'TRUE']);
  });

  it('refuses what the type does not hold', () => {
    expect(['1', '-2.5', '1e3', '1e999', '', 'x', '1,5'].map((text) => fits(text, distance))).toEqual([
      true,
      true,
      true,
      false,
      false,
      false,
      false,
    ]);
    expect(['0', '65535', '65536', '-1', '1.5'].map((text) => fits(text, axes))).toEqual([
      true,
      true,
      false,
      false,
      false,
    ]);
    expect([fits('TRUE', symmetric), fits('1', symmetric)]).toEqual([true, false]);
  });
});
