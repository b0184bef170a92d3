/**
 * A WebSocket that keeps connecting: the one owner of reconnection for the online channel, the events of a project and
 * the language client.
 *
 * Pauses grow from `FIRST_PAUSE_MS` to `LONGEST_PAUSE_MS` and are scattered by a quarter, so that many browsers do not come
 * back to a restarted server in the same moment. A connection that has brought a message begins again with the first
 * pause; one that the server closes at once does not. What has to be said on each connection (subscriptions, documents) is
 * said in `opened`, so a new connection is like the first.
 */

/** The part of WebSocket that is needed; tests pass their own. */
export interface SocketLike {
  binaryType: string;
  readonly readyState: number;
  onopen: (() => void) | null;
  onclose: ((event: { code: number; reason: string }) => void) | null;
  onmessage: ((event: { data: unknown }) => void) | null;
  send: (text: string) => void;
  close: () => void;
}

export type SocketState = 'connecting' | 'open' | 'waiting' | 'closed';

export interface SocketEvents {
  /** Connected; `again` after a gap in which messages may have been missed. */
  opened?: (again: boolean) => void;
  message: (data: unknown) => void;
  /** The connection broke, or could not be made; reported once until the next `opened`. */
  lost?: () => void;
  stateChanged?: (state: SocketState) => void;
}

export interface SocketEnvironment {
  connect: (url: string) => SocketLike;
  /** Calls back after a pause; the answer cancels. */
  after: (ms: number, callback: () => void) => () => void;
  random: () => number;
}

export const BROWSER_SOCKETS: SocketEnvironment = {
  connect: (url) => new WebSocket(url) as unknown as SocketLike,
  after: (ms, callback) => {
    const timer = setTimeout(callback, ms);
    return () => clearTimeout(timer);
  },
  random: Math.random,
};

export const FIRST_PAUSE_MS = 500;
export const LONGEST_PAUSE_MS = 10_000;
const SCATTER = 0.25;
const OPEN = 1;

export class ReconnectingSocket {
  private socket: SocketLike | null = null;
  private cancelRetry: (() => void) | null = null;
  private pause = FIRST_PAUSE_MS;
  private present: SocketState = 'closed';
  private everOpened = false;
  private lossReported = false;

  constructor(
    private readonly url: string,
    private readonly events: SocketEvents,
    private readonly environment: SocketEnvironment = BROWSER_SOCKETS,
  ) {
    this.open();
  }

  get state(): SocketState {
    return this.present;
  }

  /** Whether it was sent: nothing is kept for later, `opened` says what a new connection needs. */
  send(message: unknown): boolean {
    if (this.socket?.readyState !== OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  /** Ends this connection and makes a new one at once: what was agreed on it no longer holds. */
  renew(): void {
    if (this.present === 'closed') return;
    this.drop();
    this.reportLost();
    this.open();
  }

  /** For good; no loss is reported. */
  close(): void {
    this.drop();
    this.change('closed');
  }

  private open(): void {
    this.change('connecting');
    const socket = this.environment.connect(this.url);
    this.socket = socket;
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      if (socket !== this.socket) return;
      const again = this.everOpened;
      this.everOpened = true;
      this.lossReported = false;
      this.change('open');
      this.events.opened?.(again);
    };
    socket.onmessage = (event) => {
      if (socket !== this.socket) return;
      this.pause = FIRST_PAUSE_MS;
      this.events.message(event.data);
    };
    socket.onclose = () => {
      if (socket === this.socket) this.broken();
    };
  }

  private broken(): void {
    this.socket = null;
    const scattered = this.pause * (1 - SCATTER + 2 * SCATTER * this.environment.random());
    this.pause = Math.min(this.pause * 2, LONGEST_PAUSE_MS);
    this.cancelRetry = this.environment.after(scattered, () => this.open());
    this.change('waiting');
    this.reportLost();
  }

  private drop(): void {
    this.cancelRetry?.();
    this.cancelRetry = null;
    const socket = this.socket;
    this.socket = null;
    socket?.close();
  }

  private reportLost(): void {
    if (this.lossReported) return;
    this.lossReported = true;
    this.events.lost?.();
  }

  private change(state: SocketState): void {
    if (state === this.present) return;
    this.present = state;
    this.events.stateChanged?.(state);
  }
}
