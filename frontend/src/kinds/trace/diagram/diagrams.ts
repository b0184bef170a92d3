/** Which diagrams a trace has, and what is in each (TRC-03, TRC-12, TRC-62). Pure functions. */
import type { Appearance, TraceData, ValueAxis } from '../configuration';
import { channelName } from '../configuration';

/** A curve that is computed for the eye alone: the derivative or the integral of a variable. */
export interface Computed {
  record: number;
  channel: number;
  operation: 'derivative' | 'integral';
}

export interface DiagramModel {
  key: string;
  record: number;
  title: string;
  /** Channels of the record, in order. */
  channels: readonly number[];
  computed: Computed | null;
  appearance: Appearance;
  /** By number; the first one belongs to the axis at the left. */
  y: ReadonlyMap<number, ValueAxis>;
}

const MOST_IN_A_ROW = 3;

/** Single-channel: one diagram a record; multi-channel: one a variable. Variables that are not visible have none. */
export function diagramsOf(data: TraceData, multi: boolean, computed: readonly Computed[]): DiagramModel[] {
  return data.records.flatMap((record, at) => {
    const { appearance } = record;
    const visible = record.channels.flatMap((channel, k) => (channel.visible ? [k] : []));
    const own: DiagramModel[] = multi
      ? visible.map((k) => ({
          key: `${at}.${k}`,
          record: at,
          title: channelName(record.channels[k]!),
          channels: [k],
          computed: null,
          appearance,
          y: new Map([[record.channels[k]!.axis, record.channels[k]!.appearance]]),
        }))
      : [
          {
            key: `${at}`,
            record: at,
            title: record.name,
            channels: visible,
            computed: null,
            appearance,
            y: axesOf(data, at, visible),
          },
        ];
    const further = computed
      .filter((one) => one.record === at && record.channels[one.channel] !== undefined)
      .map((one): DiagramModel => {
        const { major: _major, minor: _minor, ...axis } = record.channels[one.channel]!.appearance;
        return {
          key: `${at}.${one.channel}.${one.operation}`,
          record: at,
          title: channelName(record.channels[one.channel]!),
          channels: [one.channel],
          computed: one,
          appearance,
          y: new Map([[0, { ...axis, major: 0, minor: 0, mode: 'auto' as const, description: '' }]]),
        };
      });
    return [...own, ...further];
  });
}

/** The axes of a diagram of many variables: that of the record, and further ones of the first variable on each. */
function axesOf(data: TraceData, at: number, visible: readonly number[]): Map<number, ValueAxis> {
  const record = data.records[at]!;
  const numbers = [...new Set(visible.map((k) => record.channels[k]!.axis))].sort((one, other) => one - other);
  if (numbers.length === 0) return new Map([[0, record.appearance.y]]);
  return new Map(
    numbers.map((number, place) => [
      number,
      place === 0
        ? record.appearance.y
        : record.channels[visible.find((k) => record.channels[k]!.axis === number)!]!.appearance,
    ]),
  );
}

/** Rows of diagrams: one above another, or side by side, at most three in a row (TRC-12). */
export function rowsOf(diagrams: readonly DiagramModel[], oneColumn: boolean): DiagramModel[][] {
  const each = oneColumn ? 1 : MOST_IN_A_ROW;
  return Array.from({ length: Math.ceil(diagrams.length / each) }, (_, row) =>
    diagrams.slice(row * each, (row + 1) * each),
  );
}
