/** The samples of one source as they are drawn: tiles of each record, of its formulas, derivatives and integrals. */
import type { Range } from '@/editors/plot/scales';
import { t } from '@/i18n';
import { channelKey, computed, parseFormula } from '../analysis/formula';
import { channelName, type Channel, type TraceData } from '../configuration';
import { joined, type Curve, type Curves } from './curves';
import { fetchDerived, fetchExtent, fetchWindow, MOST_POINTS, type Operation, type Source } from './source';
import { TileStore, type FetchWindow, type Piece } from './tileStore';
import type { TraceWindow } from './windowFormat';

const RETRY_MS = 2000;
/** Where nothing is known of the distance of samples. */
const USUAL_INTERVAL = 1e6;

export interface CurveOf {
  curves: Curves;
  curve: Curve;
}

interface RecordData {
  extent: Range | null;
  trigger: number | null;
  samples: number;
  interval: number;
}

/** What is recorded where, as state or recording say it. */
export interface RunShape {
  data: TraceData;
  /** Moment that times count from, where it is known before the first answer. */
  base: bigint | null;
  records: readonly { interval_ns: number; channels: readonly { index: number; name: string }[] }[];
}

/** What was joined last: all channels of a record are drawn from it. */
interface Joined {
  view: Range;
  pixels: number;
  revision: number;
  extent: Range | null;
  curves: Curves;
}

export class RunData {
  private readonly joined = new Map<TileStore, Joined>();
  private readonly stores = new Map<string, TileStore>();
  private readonly known: (RecordData | null)[];
  private readonly listeners = new Set<() => void>();
  private closing = new AbortController();
  private retrying: ReturnType<typeof setTimeout> | null = null;
  private base: bigint | null;
  private refreshing: AbortSignal | null = null;
  private version = 0;
  failure: unknown = null;

  constructor(
    readonly source: Source,
    readonly shape: RunShape,
  ) {
    this.base = shape.base;
    this.known = shape.records.map(() => null);
  }

  /** Begins to ask; `close` ends it, and it can begin again. */
  open(): void {
    this.closing = new AbortController();
    void this.refresh();
  }

  readonly subscribe = (listener: () => void): (() => void) => {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  };
  readonly snapshot = (): number => this.version;

  get origin(): bigint | null {
    return this.base;
  }

  extent(record: number): Range | null {
    return this.known[record]?.extent ?? null;
  }

  trigger(record: number): number | null {
    return this.known[record]?.trigger ?? null;
  }

  interval(record: number): number {
    return this.known[record]?.interval ?? USUAL_INTERVAL;
  }

  /** The record of this name here, or the one at the same place; null where there is none. */
  recordOf(name: string, at: number): number | null {
    const { records } = this.shape.data;
    const named = records.findIndex((record) => record.name.toLowerCase() === name.toLowerCase());
    if (named >= 0) return named;
    return at < records.length ? at : null;
  }

  /** Index of a recorded variable here; null where it was not recorded. */
  channelOf(record: number, channel: Channel): number | null {
    const key = (text: string) => text.replace(/\s+/g, '').toLowerCase();
    const recorded = new Set(this.shape.records[record]?.channels.map(({ index }) => index));
    const found = this.shape.data.records[record]?.channels.findIndex(
      (one, at) => recorded.has(at) && key(one.variable) === key(channel.variable),
    );
    return found === undefined || found < 0 ? null : found;
  }

  /** Asks how far the samples reach now; tiles that were not complete are fetched again when they are drawn. */
  async refresh(): Promise<void> {
    const { signal } = this.closing;
    if (this.refreshing === signal || signal.aborted) return;
    this.refreshing = signal;
    try {
      for (let record = 0; record < this.known.length; record += 1) {
        const { base, window } = await fetchExtent(this.source, record, this.base, signal);
        this.base ??= base;
        this.known[record] = {
          extent: this.base === null ? null : window.extent,
          trigger: window.trigger,
          samples: window.samples,
          interval: this.shape.records[record]?.interval_ns || USUAL_INTERVAL,
        };
      }
      this.failure = null;
      for (const store of this.stores.values()) store.grown();
    } catch (error) {
      if (!signal.aborted) this.failed(error);
    } finally {
      if (this.refreshing === signal) this.refreshing = null;
    }
    if (!signal.aborted) this.changed();
  }

  /**
   * The curve of a channel within a view, or what is computed from it; null as long as there is nothing. A formula is
   * over the channels of this run, whatever their configuration is now.
   */
  curve(record: number, channel: Channel, view: Range, pixels: number, operation?: Operation): CurveOf | null {
    const formula = channel.formula.trim();
    const index = formula === '' ? this.channelOf(record, channel) : null;
    // What is computed from a formula would need it as a channel of its own.
    if (formula === '' ? index === null : operation !== undefined) return null;
    const store = this.store(record, index, formula, operation);
    if (store === null) return null;
    const curves = this.curvesOf(store, record, view, pixels);
    if (store.failure !== null) this.failed(store.failure);
    const alone = formula !== '' || operation !== undefined;
    const curve = alone ? curves.channels.values().next().value : curves.channels.get(index!);
    return curve === undefined ? null : { curves, curve };
  }

  /** Number of a variable among those that were recorded, as the server counts them. */
  numberOf(record: number, index: number): number {
    return this.shape.records[record]?.channels.findIndex((one) => one.index === index) ?? -1;
  }

  /** A formula within a range: of each sample, or where there are too many of the ends of each point. */
  async formula(record: number, text: string, range: Range, signal: AbortSignal): Promise<TraceWindow> {
    const parsed = parseFormula(text);
    const own = this.shape.data.records[record]?.channels ?? [];
    const indices = parsed.channels.map((name) =>
      own.findIndex((one) => one.formula.trim() === '' && channelKey(channelName(one)) === channelKey(name)),
    );
    const numbers = indices.map((index) => this.numberOf(record, index));
    const missing = numbers.findIndex((number) => number < 0);
    if (missing >= 0) throw new Error(t('trace.fault.formula.channel', { name: parsed.channels[missing]! }));
    const window = await fetchWindow(this.source, record, this.base!, range, MOST_POINTS, signal, numbers);
    const values = (of: 'low' | 'high') =>
      computed(
        parsed,
        indices.map((index) => window.channels.find((one) => one.index === index)![of]),
        window.time.length,
      );
    const [one, other] = window.step === 1 ? [values('low'), null] : [values('low'), values('high')];
    const low = other === null ? one : one.map((value, k) => Math.min(value, other[k]!));
    const high = other === null ? one : one.map((value, k) => Math.max(value, other[k]!));
    return { ...window, channels: [{ index: 0, name: text, type: 'LREAL', low, high }] };
  }

  get memory(): number {
    return [...this.stores.values()].reduce((sum, store) => sum + store.size.bytes, 0);
  }

  close(): void {
    this.closing.abort();
    if (this.retrying !== null) clearTimeout(this.retrying);
    this.retrying = null;
    for (const store of this.stores.values()) store.close();
    this.stores.clear();
    this.joined.clear();
  }

  private curvesOf(store: TileStore, record: number, view: Range, pixels: number): Curves {
    const extent = this.extent(record);
    const last = this.joined.get(store);
    const same =
      last?.pixels === pixels &&
      last.revision === store.revision &&
      last.extent === extent &&
      last.view.min === view.min &&
      last.view.max === view.max;
    if (same) return last.curves;
    const curves = joined(this.clipped(store.pieces(view, pixels), record));
    this.joined.set(store, { view, pixels, revision: store.revision, extent, curves });
    return curves;
  }

  /** Samples that the ring has forgotten are not drawn (trace EX-05). */
  private clipped(pieces: Piece[], record: number): Piece[] {
    const extent = this.extent(record);
    if (extent === null) return [];
    return pieces.flatMap(({ range, window }) => {
      const [min, max] = [Math.max(range.min, extent.min), range.max];
      return min < max ? [{ range: { min, max }, window, begins: min > range.min }] : [];
    });
  }

  private store(
    record: number,
    index: number | null,
    formula: string,
    operation: Operation | undefined,
  ): TileStore | null {
    const { base, source } = this;
    if (base === null || this.known[record] == null) return null;
    const key = operation ? `${record} ${index} ${operation}` : formula !== '' ? `${record} ${formula}` : `${record}`;
    const found = this.stores.get(key);
    if (found) return found;
    const fetch: FetchWindow = (range, width, signal) => {
      if (formula !== '') return this.formula(record, formula, range, signal);
      if (operation === undefined) return fetchWindow(source, record, base, range, width, signal);
      const of = { record, channel: this.numberOf(record, index!), operation };
      // An integral is from the first sample, whatever part of it is seen.
      const whole = operation === 'integral' ? this.extent(record) : null;
      return fetchDerived(source, of, base, whole ?? range, whole ? MOST_POINTS : width, signal);
    };
    const made = new TileStore(fetch, this.interval(record), () => this.changed());
    this.stores.set(key, made);
    return made;
  }

  private failed(error: unknown): void {
    this.failure = error;
    this.retrying ??= setTimeout(() => {
      this.retrying = null;
      for (const store of this.stores.values()) store.retry();
      void this.refresh();
    }, RETRY_MS);
  }

  private changed(): void {
    this.version += 1;
    for (const listener of this.listeners) listener();
  }
}
