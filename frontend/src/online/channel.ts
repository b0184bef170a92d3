/**
 * The online socket of one runtime (`/api/v1/online`): subscriptions, states, forces; `api/socket.ts` keeps it connected.
 *
 * Views hold groups of expressions; a group is one subscription, so all values of a frame belong to one cycle.
 * A changed group is subscribed again under a new number, and the old subscription ends when the answer is there:
 * values never flicker while the user scrolls.
 */
import { language } from '@/i18n';
import { BROWSER_SOCKETS, ReconnectingSocket, type SocketEnvironment } from '@/api/socket';
import type { ImagePlace, RuntimeState } from '@/api/types';
import type { ValueBoard } from './board';
import { isPast, readFrame } from './frame';
import { expressionKey, type SubscribedItem } from './item';

export interface ChannelEvents {
  state: (state: RuntimeState) => void;
  forces: (expressions: readonly string[], places: readonly ImagePlace[]) => void;
  lost: () => void;
  /** Values are those of this past cycle from now on, null: live ones; or why the one asked for cannot be shown. */
  looked: (cycle: number | null, problem: string | null) => void;
  /** The longest interval at which values come now in place of a shorter one that was asked for; null: all as asked. */
  paced: (intervalMs: number | null) => void;
}

interface Group {
  expressions: readonly string[];
  intervalMs: number;
  /** What the server gives: longer than asked where its user watches much. */
  givenMs: number;
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

export class OnlineChannel {
  private readonly socket: ReconnectingSocket;
  private readonly groups = new Set<Group>();
  private readonly byId = new Map<number, Group>();
  /** Subscriptions this very connection knows of. */
  private readonly announced = new Set<number>();
  private nextId = 1;
  /** The past cycle that the server shows; null: live values. */
  private past: number | null = null;

  constructor(
    readonly board: ValueBoard,
    url: string,
    private readonly events: ChannelEvents,
    private readonly environment: SocketEnvironment = BROWSER_SOCKETS,
  ) {
    this.socket = new ReconnectingSocket(
      url,
      {
        opened: () => {
          if (language() !== 'en') this.speak();
          this.resubscribe();
        },
        message: (data) => this.message(data),
        lost: () => {
          this.announced.clear();
          this.past = null;
          this.events.lost();
        },
      },
      environment,
    );
  }

  /** Tells the server the language of its sentences: what it has said comes again in it. */
  speak(): void {
    this.socket.send({ op: 'speak', language: language() });
  }

  /** Watches expressions until the handle is released; `update` changes what is watched. */
  watch(expressions: readonly string[], intervalMs: number): GroupHandle {
    const group: Group = {
      expressions: distinct(expressions),
      intervalMs,
      givenMs: intervalMs,
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
        group.cancelUpdate ??= this.environment.after(SETTLE_MS, () => {
          group.cancelUpdate = null;
          if (this.groups.has(group)) this.subscribe(group);
        });
      },
      release: () => this.release(group),
    };
  }

  /** Asks for the values of a past cycle in all groups, or with null for live ones; `looked` tells the outcome. */
  lookBack(cycle: number | null): void {
    if (this.socket.state === 'open') this.socket.send({ op: 'look_back', cycle });
  }

  close(): void {
    for (const group of this.groups) group.cancelUpdate?.();
    this.socket.close();
  }

  private message(data: unknown): void {
    if (data instanceof ArrayBuffer) {
      const frame = readFrame(data);
      // What was on its way when the server turned to another cycle must not be shown as of this one.
      if (this.past === null ? !isPast(frame) : isPast(frame) && Number(frame.cycle) === this.past)
        this.board.receive(frame);
      return;
    }
    if (typeof data !== 'string') return;
    const message = JSON.parse(data) as { op?: string; [field: string]: unknown };
    if (message.op === 'subscribed') {
      this.subscribed(message.id as number, message.items as readonly SubscribedItem[]);
      this.paced(message.id as number, message.interval_ms as number);
    } else if (message.op === 'paced') this.paced(message.id as number, message.interval_ms as number);
    else if (message.op === 'looked_back') {
      this.past = message.cycle as number | null;
      this.events.looked(this.past, message.problem as string | null);
    } else if (message.op === 'forces')
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
  }

  private paced(id: number, intervalMs: number): void {
    const group = this.byId.get(id);
    if (group === undefined) return;
    group.givenMs = intervalMs;
    this.tellPace();
  }

  private tellPace(): void {
    const longer = [...this.groups].filter((one) => one.givenMs > one.intervalMs).map((one) => one.givenMs);
    this.events.paced(longer.length === 0 ? null : Math.max(...longer));
  }

  private subscribe(group: Group): void {
    if (group.pending !== null) this.end(group.pending);
    group.pending = null;
    if (group.expressions.length === 0) {
      if (group.active !== null) this.end(group.active);
      group.active = null;
      return;
    }
    if (this.socket.state !== 'open') return;
    const id = this.nextId++;
    group.pending = id;
    this.byId.set(id, group);
    this.announced.add(id);
    this.socket.send({ op: 'subscribe', id, expressions: group.expressions, interval_ms: group.intervalMs });
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
    if (group.givenMs > group.intervalMs) this.tellPace();
  }

  private end(id: number): void {
    this.byId.delete(id);
    this.board.close(id);
    if (this.announced.delete(id)) this.socket.send({ op: 'unsubscribe', id });
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
