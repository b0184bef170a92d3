/** The configuration of a trace: what may be entered, new records and variables, changes of several at once. Pure functions. */
import type { Schemas } from '@/api/types';
import { signedDuration, timeLiteral } from '@/iec/duration';
import { FormulaError, parseFormula } from './analysis/formula';

export type GraphType = Channel['graph'];
export type Edge = TraceRecord['trigger']['edge'];
export const GRAPH_TYPES: readonly GraphType[] = ['line', 'step', 'points', 'cross', 'saw_tooth', 'none'];
export const EDGES: readonly Edge[] = ['none', 'positive', 'negative', 'both'];

export type TraceData = Schemas['TraceData-Output'];
export type TraceRecord = Schemas['TraceRecord-Output'];
export type Channel = Schemas['TraceChannel-Output'];
export type Warning = Schemas['TraceLimit-Output'];
export type Appearance = Schemas['TraceAppearance-Output'];
export type TimeAxis = Schemas['TraceTimeAxis-Output'];
export type ValueAxis = Schemas['TraceValueAxis-Output'];

export const LIMITS = {
  refresh_rate: [50, 60_000],
  points: [1, 1_000_000],
  every: [1, 1_000_000],
  buffer: [1, 1_000_000],
  position: [0, 100],
  font_size: [6, 40],
} as const;
export const MOST_RECORDS = 16;
export const MOST_CHANNELS = 256;

const AXIS: Pick<TimeAxis, 'mode' | 'reverse' | 'description' | 'grid' | 'grid_color' | 'arrow' | 'position'> = {
  mode: 'auto',
  reverse: false,
  description: '',
  grid: true,
  grid_color: '',
  arrow: 'none',
  position: 'low',
};
export const USUAL_TIME_AXIS: TimeAxis = {
  ...AXIS,
  minimum: 'T#0s',
  maximum: 'T#10s',
  length: 'T#10s',
  major: '',
  minor: '',
};
export const USUAL_VALUE_AXIS: ValueAxis = { ...AXIS, minimum: 0, maximum: 100, length: 100, major: 0, minor: 0 };
export const USUAL_APPEARANCE: Appearance = {
  x: USUAL_TIME_AXIS,
  y: USUAL_VALUE_AXIS,
  background: '',
  selected_background: '',
  font_size: 12,
};
const WARNING: Warning = { on: false, limit: 0, color: '#ff0000' };

export function newChannel(variable = '', appearance: ValueAxis = USUAL_VALUE_AXIS): Channel {
  return {
    variable,
    formula: '',
    name: '',
    color: '',
    graph: 'line',
    axis: 0,
    minimum_warning: WARNING,
    maximum_warning: WARNING,
    visible: true,
    appearance,
  };
}

export function newRecord(records: readonly TraceRecord[], appearance: Appearance = USUAL_APPEARANCE): TraceRecord {
  const taken = new Set(records.map(({ name }) => name.toLowerCase()));
  let number = 1;
  while (taken.has(`record${number}`)) number += 1;
  return {
    name: `Record${number}`,
    task: '',
    every: 1,
    condition: '',
    trigger: { variable: '', edge: 'none', level: '', position: 50 },
    buffer: 100,
    comment: '',
    trace_pou: false,
    appearance,
    channels: [],
  };
}

/** What a channel is called in the legend and in formulas. */
export function channelName(channel: Channel): string {
  return channel.name.trim() || channel.variable.trim() || channel.formula.trim();
}

/** Whether the controller samples it; formulas are over what is sampled. */
const isRecorded = ({ variable, formula }: Channel) => formula.trim() === '' && variable.trim() !== '';

/** A record, or a variable of it. */
export interface Node {
  record: number;
  channel: number | null;
}

export const sameNode = (one: Node, other: Node) => one.record === other.record && one.channel === other.channel;
export const nodeKey = ({ record, channel }: Node) => (channel === null ? `${record}` : `${record}.${channel}`);

export function changeRecord(data: TraceData, record: number, change: Partial<TraceRecord>): TraceData {
  return { ...data, records: data.records.map((one, at) => (at === record ? { ...one, ...change } : one)) };
}

/** The same change of several variables (section 3: variable settings can be edited for several at once). */
export function changeChannels(
  data: TraceData,
  nodes: readonly Node[],
  change: (channel: Channel) => Channel,
): TraceData {
  const records = data.records.map((record, at) => {
    const chosen = nodes.filter((node) => node.record === at);
    if (chosen.length === 0) return record;
    return {
      ...record,
      channels: record.channels.map((channel, k) =>
        chosen.some((node) => node.channel === k) ? change(channel) : channel,
      ),
    };
  });
  return { ...data, records };
}

/** Adds variables to a record, but none that it has already (TRC-30); makes the first record where there is none. */
export function withVariables(data: TraceData, record: number, variables: readonly string[]): TraceData {
  const records = data.records.length === 0 ? [newRecord([])] : data.records;
  const at = Math.min(record, records.length - 1);
  const own = records[at]!;
  const seen = new Set(own.channels.map(({ variable }) => variableKey(variable)));
  const fresh = variables.filter((one) => {
    const key = variableKey(one);
    if (key === '' || seen.has(key)) return false;
    seen.add(key);
    return true;
  });
  const channels = [...own.channels, ...fresh.map((one) => newChannel(one.trim(), own.appearance.y))];
  return changeRecord({ ...data, records }, at, { channels: channels.slice(0, MOST_CHANNELS) });
}

const variableKey = (text: string) => text.replace(/\s+/g, '').toUpperCase();

/** The trace without records and variables. */
export function withoutNodes(data: TraceData, nodes: readonly Node[]): TraceData {
  const gone = new Set(nodes.map(nodeKey));
  const records = data.records.flatMap((record, at) => {
    if (gone.has(nodeKey({ record: at, channel: null }))) return [];
    return [
      {
        ...record,
        channels: record.channels.filter((_, k) => !gone.has(nodeKey({ record: at, channel: k }))),
      },
    ];
  });
  return { ...data, records };
}

/** Nodes from one to the other in the order of the tree, for a choice with Shift. */
export function nodesBetween(data: TraceData, from: Node, to: Node): Node[] {
  const all = nodesOf(data);
  const ends = [from, to].map((node) => all.findIndex((one) => sameNode(one, node)));
  return all.slice(Math.min(...ends), Math.max(...ends) + 1);
}

export function nodesOf(data: TraceData): Node[] {
  return data.records.flatMap((record, at) => [
    { record: at, channel: null },
    ...record.channels.map((_, channel) => ({ record: at, channel })),
  ]);
}

export type FaultKey =
  | 'trace.fault.variable'
  | 'trace.fault.twice'
  | 'trace.fault.name'
  | 'trace.fault.nameTwice'
  | 'trace.fault.number'
  | 'trace.fault.limit'
  | 'trace.fault.time'
  | 'trace.fault.order'
  | 'trace.fault.length'
  | 'trace.fault.triggerVariable'
  | 'trace.fault.formula.empty'
  | 'trace.fault.formula.unexpected'
  | 'trace.fault.formula.end'
  | 'trace.fault.formula.function'
  | 'trace.fault.formula.arguments'
  | 'trace.fault.formula.tooDeep'
  | 'trace.fault.formula.channel';

export interface Fault {
  node: Node | null;
  field: string;
  key: FaultKey;
  values: Record<string, string | number>;
}

/** What cannot be stored, with its place; empty where all can. */
export function faultsOf(data: TraceData): Fault[] {
  const found: Fault[] = [];
  const number = (node: Node | null, field: keyof typeof LIMITS, value: number) => {
    const [least, most] = LIMITS[field];
    if (!Number.isInteger(value) || value < least || value > most)
      found.push({ node, field, key: 'trace.fault.number', values: { least, most } });
  };
  number(null, 'refresh_rate', data.refresh_rate);
  number(null, 'points', data.points);
  data.records.forEach((record, at) => {
    const node = { record: at, channel: null };
    const add = (field: string, key: FaultKey, values: Fault['values'] = {}) =>
      found.push({ node, field, key, values });
    if (record.name.trim() === '') add('name', 'trace.fault.name');
    else if (data.records.some((one, k) => k < at && variableKey(one.name) === variableKey(record.name)))
      add('name', 'trace.fault.nameTwice', { name: record.name });
    number(node, 'every', record.every);
    number(node, 'buffer', record.buffer);
    number(node, 'position', record.trigger.position);
    number(node, 'font_size', record.appearance.font_size);
    if (record.trigger.edge !== 'none' && record.trigger.variable.trim() === '')
      add('trigger.variable', 'trace.fault.triggerVariable');
    timeAxisFaults(record.appearance.x).forEach(({ field, key }) => add(`x.${field}`, key));
    valueAxisFaults(record.appearance.y).forEach(({ field, key }) => add(`y.${field}`, key));
    record.channels.forEach((channel, k) => found.push(...channelFaults(record, { record: at, channel: k }, channel)));
  });
  return found;
}

function channelFaults(record: TraceRecord, node: Node, channel: Channel): Fault[] {
  const found: Fault[] = [];
  const add = (field: string, key: FaultKey, values: Fault['values'] = {}) => found.push({ node, field, key, values });
  const at = node.channel ?? 0;
  if (channel.formula.trim() !== '') {
    const fault = formulaFault(channel.formula, record.channels.filter(isRecorded).map(channelName));
    if (fault) add('formula', fault.key, fault.values);
  } else if (channel.variable.trim() === '') add('variable', 'trace.fault.variable');
  else if (
    record.channels.some(
      (one, k) => k < at && one.formula.trim() === '' && variableKey(one.variable) === variableKey(channel.variable),
    )
  )
    add('variable', 'trace.fault.twice', { name: channel.variable });
  for (const warning of ['minimum_warning', 'maximum_warning'] as const)
    if (!Number.isFinite(channel[warning].limit)) add(warning, 'trace.fault.limit');
  valueAxisFaults(channel.appearance).forEach(({ field, key }) => add(`y.${field}`, key));
  return found;
}

/** What is wrong with a formula over channels of these names; null when it can be computed. */
export function formulaFault(text: string, names: readonly string[]): Pick<Fault, 'key' | 'values'> | null {
  try {
    const known = new Set(names.map(variableKey));
    const missing = parseFormula(text).channels.find((name) => !known.has(variableKey(name)));
    return missing === undefined ? null : { key: 'trace.fault.formula.channel', values: { name: missing } };
  } catch (error) {
    if (!(error instanceof FormulaError)) throw error;
    return { key: `trace.fault.formula.${error.fault}`, values: { word: error.word, place: error.at + 1 } };
  }
}

interface AxisFault {
  field: string;
  key: FaultKey;
}

export function timeAxisFaults(axis: TimeAxis): AxisFault[] {
  const found: AxisFault[] = [];
  const [minimum, maximum] = [signedDuration(axis.minimum), signedDuration(axis.maximum)];
  if (minimum === null) found.push({ field: 'minimum', key: 'trace.fault.time' });
  if (maximum === null) found.push({ field: 'maximum', key: 'trace.fault.time' });
  if (minimum !== null && maximum !== null && minimum >= maximum)
    found.push({ field: 'maximum', key: 'trace.fault.order' });
  if (!((timeLiteral(axis.length) ?? 0) > 0)) found.push({ field: 'length', key: 'trace.fault.time' });
  for (const field of ['major', 'minor'] as const)
    if (axis[field].trim() !== '' && !((timeLiteral(axis[field]) ?? 0) > 0))
      found.push({ field, key: 'trace.fault.time' });
  return found;
}

export function valueAxisFaults(axis: ValueAxis): AxisFault[] {
  const found: AxisFault[] = [];
  for (const field of ['minimum', 'maximum', 'major', 'minor'] as const)
    if (!Number.isFinite(axis[field]) || (field.startsWith('m') && field.endsWith('or') && axis[field] < 0))
      found.push({ field, key: 'trace.fault.limit' });
  if (axis.minimum >= axis.maximum) found.push({ field: 'maximum', key: 'trace.fault.order' });
  if (!(axis.length > 0)) found.push({ field: 'length', key: 'trace.fault.length' });
  return found;
}

/** Nanoseconds that a record holds: buffer x n x task interval (TRC-25, trace EX-02). */
export function recordedSpan(record: Pick<TraceRecord, 'buffer' | 'every'>, intervalNs: number): number {
  return record.buffer * record.every * intervalNs;
}

/** What the controller records of a configuration, to compare; the rest is how it looks and needs no download (trace EX-07). */
export function recordedPart({ points, records }: TraceData): string {
  return JSON.stringify([
    points,
    records.map(({ name, task, every, condition, trigger, buffer, channels }) => [
      [name, task, every, condition, buffer],
      [trigger.variable, trigger.edge, trigger.level, trigger.position],
      channels.filter(isRecorded).map(({ variable }) => variable.trim()),
    ]),
  ]);
}
