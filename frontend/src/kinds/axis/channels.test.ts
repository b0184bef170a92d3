import { describe, expect, it } from 'vitest';
import { bindingOf, channelFault, channelsOf, fittingTypes, unboundChannels, type Binding } from './channels';
import { sampleAxis } from './sampleAxis';

const channel = (name: string) => channelsOf('SM_Drive_GenericDSP402').find((one) => one.name === name)!;
const STATUS = channel('in.wStatusWord');
const POSITION = channel('out.diSetPosition');
const OFFLINE = channel('in.bOffline');
const fault = (one: typeof STATUS, place: string, type: Binding['type'] = one.type) =>
  channelFault(one, { place, type })?.text ?? null;

describe('channels', () => {
  it('are those of the drive', () => {
    expect(channelsOf('SM_Drive_Virtual')).toEqual([]);
    expect(channelsOf('SM_Drive_Simulated')).toEqual([]);
    expect(channelsOf('SM_Drive_PosControl').map(({ name }) => name)).toContain('out.iSetVelocity');
  });

  it('take what keeps their value', () => {
    expect(fittingTypes(STATUS)).toEqual(['BYTE', 'SINT', 'USINT', 'WORD', 'INT', 'UINT']);
    expect(fittingTypes(POSITION)).toEqual(['DWORD', 'DINT', 'UDINT']);
    expect(fittingTypes(OFFLINE)).toEqual(['BOOL']);
  });

  it('are bound to addresses of their size and to variables', () => {
    expect(fault(STATUS, '')).toBeNull();
    expect(fault(STATUS, '%IW0', 'UINT')).toBeNull();
    expect(fault(STATUS, '%mb7', 'SINT')).toBeNull();
    expect(fault(STATUS, 'GVL.aData[3].wState')).toBeNull();
    expect(fault(OFFLINE, '%IX2.7')).toBeNull();
    expect(fault(POSITION, '%QD4')).toBeNull();
  });

  it('say what is wrong with a place', () => {
    expect(fault(STATUS, '%IW')).toBe('axis.channels.noAddress');
    expect(fault(STATUS, 'a; b')).toBe('axis.channels.noPlace');
    expect(fault(STATUS, '%ID0')).toBe('axis.channels.wrongSize');
    expect(fault(STATUS, '%ID0', 'UDINT')).toBe('axis.channels.wrongType');
    expect(fault(OFFLINE, '%IX2')).toBe('axis.channels.wrongSize');
    expect(fault(POSITION, '%ID4')).toBe('axis.channels.input');
    expect(channelFault(POSITION, { place: '%QW4', type: 'DINT' })).toMatchObject({ example: '%QD0', type: 'DINT' });
  });

  it('that an axis needs are told while they have no place', () => {
    const axis = sampleAxis({ drive: 'SM_Drive_GenericDSP402' });
    expect(unboundChannels(axis)).toEqual([]);
    const rows = { 'in.wStatusWord': { place: '%IW0', type: 'UINT' as const } };
    const mapped = { ...axis, mapping: { automatic: false, channels: rows } };
    expect(unboundChannels(mapped).map(({ name }) => name)).toEqual([
      'in.diActPosition',
      'out.wControlWord',
      'out.diSetPosition',
    ]);
    expect(bindingOf(STATUS, mapped)).toEqual({ place: '%IW0', type: 'UINT' });
    expect(bindingOf(POSITION, mapped)).toEqual({ place: '', type: 'DINT' });
  });
});
