/** The channels of a drive and what they are bound to (AXIS-22). Pure functions. */
import type { Schemas } from '@/api/types';
import type { TextKey } from '@/i18n';
import table from './channels.json';
import type { AxisSettings } from './model';

export type Binding = Schemas['Binding'];
export type ChannelType = Binding['type'];

export interface Channel {
  /** Its path from the axis, such as `in.wStatusWord`. */
  name: string;
  type: ChannelType;
  /** Object of CiA 402. */
  index: string;
  /** Whether an axis cannot move without it. */
  needed: boolean;
}

const BITS = table.bits as Record<ChannelType, number>;
const CHANNELS = table.channels as Partial<Record<AxisSettings['drive'], Channel[]>>;
const SIZES: Record<number, string> = { 1: 'X', 8: 'B', 16: 'W', 32: 'D' };
const ADDRESS = /^%([IQM])([XBWD])(\d+)(\.[0-7])?$/i;
const VARIABLE = /^[A-Z_]\w*(\[\d+\])*(\.[A-Z_]\w*(\[\d+\])*)*$/i;

/** What a drive has to be bound; nothing where the drive is part of the axis. */
export function channelsOf(drive: AxisSettings['drive']): readonly Channel[] {
  return CHANNELS[drive] ?? [];
}

export function isInput(channel: Channel): boolean {
  return channel.name.startsWith('in.');
}

/** The types that a value of a channel may have where it is bound: of inputs no wider ones, of outputs no narrower ones. */
export function fittingTypes(channel: Channel): ChannelType[] {
  const wanted = BITS[channel.type];
  return (Object.keys(BITS) as ChannelType[]).filter((type) => {
    if ((BITS[type] === 1) !== (wanted === 1)) return false;
    return isInput(channel) ? BITS[type] <= wanted : BITS[type] >= wanted;
  });
}

/** The binding of a channel; one that is not stored yet is empty. */
export function bindingOf(channel: Channel, axis: AxisSettings): Binding {
  return axis.mapping.channels[channel.name] ?? { place: '', type: channel.type };
}

export interface ChannelFault {
  text: TextKey;
  place: string;
  type: string;
  example: string;
}

/** What is wrong with a row, as far as it says itself; the build checks variables. */
export function channelFault(channel: Channel, binding: Binding): ChannelFault | null {
  const place = binding.place.trim();
  if (place === '') return null;
  const bits = BITS[binding.type];
  const example = `%${isInput(channel) ? 'I' : 'Q'}${SIZES[bits]}${bits === 1 ? '0.0' : '0'}`;
  const fault = (text: TextKey): ChannelFault => ({ text, place, type: binding.type, example });
  if (!fittingTypes(channel).includes(binding.type)) return fault('axis.channels.wrongType');
  const address = ADDRESS.exec(place);
  if (address === null) {
    if (place.startsWith('%')) return fault('axis.channels.noAddress');
    return VARIABLE.test(place) ? null : fault('axis.channels.noPlace');
  }
  const [, area, size, , bit] = address;
  if (!isInput(channel) && area!.toUpperCase() === 'I') return fault('axis.channels.input');
  const fits = size!.toUpperCase() === SIZES[bits] && (bits === 1) === (bit !== undefined);
  return fits ? null : fault('axis.channels.wrongSize');
}

/** Channels that an axis cannot move without and that have no place. */
export function unboundChannels(axis: AxisSettings): Channel[] {
  if (axis.mapping.automatic) return [];
  return channelsOf(axis.drive).filter((channel) => channel.needed && bindingOf(channel, axis).place.trim() === '');
}
