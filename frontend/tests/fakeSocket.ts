import type { SocketEnvironment, SocketLike } from '@/api/socket';

/** A WebSocket whose server is the test. */
export class FakeSocket implements SocketLike {
  binaryType = '';
  readyState = 0;
  onopen: (() => void) | null = null;
  onclose: ((event: { code: number; reason: string }) => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;
  sent: { op: string; id: number; expressions?: string[] }[] = [];

  send(text: string) {
    this.sent.push(JSON.parse(text) as (typeof this.sent)[number]);
  }
  close() {
    this.readyState = 3;
  }
  accept() {
    this.readyState = 1;
    this.onopen?.();
  }
  drop() {
    this.readyState = 3;
    this.onclose?.({ code: 1006, reason: '' });
  }
  say(message: unknown) {
    this.onmessage?.({ data: JSON.stringify(message) });
  }
}

/** Sockets and timers that the test drives; pauses are not scattered. */
export function fakeSockets<Socket extends FakeSocket>(make: () => Socket) {
  const sockets: Socket[] = [];
  const timers: { ms: number; run: () => void }[] = [];
  const environment: SocketEnvironment = {
    connect: () => {
      const socket = make();
      sockets.push(socket);
      return socket;
    },
    after: (ms, run) => {
      const timer = { ms, run };
      timers.push(timer);
      return () => timers.splice(timers.indexOf(timer), 1);
    },
    random: () => 0.5,
  };
  const elapse = () => timers.splice(0).forEach((timer) => timer.run());
  return { sockets, timers, environment, elapse };
}
