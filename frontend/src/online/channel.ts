/**
 * The online socket of one runtime (`/api/v1/online`): subscriptions, reconnection, states.
 *
 * Views hold groups of expressions; a group is one subscription, so all values of a frame belong to one cycle.
 * A changed group is subscribed anew under a new number, and the old subscription ends when the answer is there:
 * values never flicker while the user scrolls.
 */
import type { ImagePlace, RuntimeState } from '@/api/types';
import type { ValueBoard } from './board';
import { readFrame } from './frame';
import { expressionKey, type SubscribedItem } from './item';

/** The part of WebSocket the channel needs; the tests pass their own. */
export interface ChannelSocket {
  binaryType: string;
  readyState: number;
  onopen: (() => void) | null;
  onclose: ((event: { code: number; reason: string }) => void) | null;
  onmessage: ((event: { data: unknown }) => void) | null;
  send: (text: string) => void;
  close: () => void;
}

export interface ChannelEvents {
  state: (state: RuntimeState) => void;
  forces: (expressions: readonly string[], places: readonly ImagePlace[]) => void;
  lost: () => void;
  restored: () => void;
  /** A subscription has been answered: errors of expressions are known now. */
  answered: (items: readonly SubscribedItem[]) => void;
}

export interface ChannelTimer {
  after: (ms: number, callback: () => void) => () => void;
}

interface Group {
  expressions: readonly string[];
  intervalMs: number;
  /** Subscription number that delivers now, and the one asked for. */
  active: number | null;
  pending: number | null;
  cancelUpdate: (() => void) | null;
}

/** Handle of a view on its group. */
export interface GroupHandle {
  update: (expressions: readonly string[]) => void;
  release: () => void;
}

const SETTLE_MS = 40;
const FIRST_RETRY_MS = 500;
const LONGEST_RETRY_MS = 8000;
const OPEN = 1;

export class OnlineChannel {
  private socket: ChannelSocket | null = null;
  private readonly groups = new Set<Group>();
  private readonly byId = new Map<number, Group>();
  /** Subscriptions this very connection knows of. */
  private readonly announced = new Set<number>();
  private nextId = 1;
  private retryMs = FIRST_RETRY_MS;
  private cancelRetry: (() => void) | null = null;
  private closed = false;
  private lost = false;

  constructor(
    readonly board: ValueBoard,
    private readonly connect: () => ChannelSocket,
    private readonly events: ChannelEvents,
    private readonly timer: ChannelTimer,
  ) {
    this.open();
  }

  /** Watches expressions until the handle is released; `update` changes what is watched. */
  watch(expressions: readonly string[], intervalMs: number): GroupHandle {
    const group: Group = {
      expressions: distinct(expressions),
      intervalMs,
      active: null,
      pending: null,
      cancelUpdate: null,
    };
    this.groups.add(group);
    this.subscribe(group);
    return {
      update: (next) => {
        const wanted = distinct(next);
        if (sameList(wanted, group.expressions)) return;
        group.expressions = wanted;
        group.cancelUpdate ??= this.timer.after(SETTLE_MS, () => {
          group.cancelUpdate = null;
          if (this.groups.has(group)) this.subscribe(group);
        });
      },
      release: () => this.release(group),
    };
  }

  close(): void {
    this.closed = true;
    this.cancelRetry?.();
    for (const group of this.groups) group.cancelUpdate?.();
    this.socket?.close();
  }

  private open(): void {
    const socket = this.connect();
    this.socket = socket;
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.retryMs = FIRST_RETRY_MS;
      if (this.lost) this.events.restored();
      this.lost = false;
      this.resubscribe();
    };
    socket.onmessage = (event) => this.message(event.data);
    socket.onclose = () => this.broken(socket);
  }

  private broken(socket: ChannelSocket): void {
    if (this.closed || socket !== this.socket) return;
    this.socket = null;
    this.announced.clear();
    if (!this.lost) this.events.lost();
    this.lost = true;
    this.cancelRetry = this.timer.after(this.retryMs, () => this.open());
    this.retryMs = Math.min(this.retryMs * 2, LONGEST_RETRY_MS);
  }

  private message(data: unknown): void {
    if (data instanceof ArrayBuffer) {
      this.board.receive(readFrame(data));
      return;
    }
    if (typeof data !== 'string') return;
    const message = JSON.parse(data) as { op?: string; [field: string]: unknown };
    if (message.op === 'subscribed') this.subscribed(message.id as number, message.items as readonly SubscribedItem[]);
    else if (message.op === 'forces')
      this.events.forces(message.expressions as readonly string[], message.places as readonly ImagePlace[]);
    else if (message.op === 'state') this.state(message);
  }

  /** The state object stands in the message itself or under `runtime` or `state`. */
  private state(message: { [field: string]: unknown }): void {
    const inner = typeof message.runtime === 'object' ? message.runtime : message;
    const state = inner as unknown as RuntimeState;
    this.events.state(state);
  }

  /** Also sent again under a known number when the places have changed: after a download or a lost runtime. */
  private subscribed(id: number, items: readonly SubscribedItem[]): void {
    const group = this.byId.get(id);
    if (group === undefined) return;
    if (group.active !== id) {
      this.board.open(id, items);
      if (group.active !== null) this.end(group.active);
      group.active = id;
    } else {
      this.board.close(id);
      this.board.open(id, items);
    }
    if (group.pending === id) group.pending = null;
    this.events.answered(items);
  }

  private subscribe(group: Group): void {
    if (group.pending !== null) this.end(group.pending);
    group.pending = null;
    if (group.expressions.length === 0) {
      if (group.active !== null) this.end(group.active);
      group.active = null;
      return;
    }
    if (this.socket?.readyState !== OPEN) return;
    const id = this.nextId++;
    group.pending = id;
    this.byId.set(id, group);
    this.announced.add(id);
    this.send({ op: 'subscribe', id, expressions: group.expressions, interval_ms: group.intervalMs });
  }

  private resubscribe(): void {
    for (const group of this.groups) this.subscribe(group);
  }

  private release(group: Group): void {
    group.cancelUpdate?.();
    this.groups.delete(group);
    if (group.pending !== null) this.end(group.pending);
    if (group.active !== null) this.end(group.active);
    group.pending = group.active = null;
  }

  private end(id: number): void {
    this.byId.delete(id);
    this.board.close(id);
    if (this.announced.delete(id) && this.socket?.readyState === OPEN) this.send({ op: 'unsubscribe', id });
  }

  private send(message: unknown): void {
    this.socket?.send(JSON.stringify(message));
  }
}

function distinct(expressions: readonly string[]): string[] {
  const seen = new Map<string, string>();
  for (const expression of expressions) {
    const key = expressionKey(expression);
    if (key !== '' && !seen.has(key)) seen.set(key, expression);
  }
  return [...seen.values()];
}

function sameList(a: readonly string[], b: readonly string[]): boolean {
  return a.length === b.length && a.every((expression, index) => expression === b[index]);
}
