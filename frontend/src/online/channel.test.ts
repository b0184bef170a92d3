import { describe, expect, it, vi } from 'vitest';
import type { RuntimeState } from '@/api/types';
import { setLanguage } from '@/i18n';
import { ValueBoard } from './board';
import { FakeSocket, fakeSockets } from '../../tests/fakeSocket';
import { OnlineChannel } from './channel';
import type { SubscribedItem } from './item';

class OnlineSocket extends FakeSocket {
  answer(id: number, expressions: string[], interval_ms = 100) {
    const items: SubscribedItem[] = expressions.map((expression, i) => ({
      expression, offset: i, size: 1, type: 'BOOL', kind: 'bool',
    })); // prettier-ignore
    this.say({ op: 'subscribed', id, items, interval_ms });
  }
}

function setUp() {
  const { sockets, timers, environment, elapse } = fakeSockets(() => new OnlineSocket());
  const log: string[] = [];
  const paces: (number | null)[] = [];
  const board = new ValueBoard({ now: () => 0, soon: (run) => run() });
  const channel = new OnlineChannel(
    board,
    'ws://host/online',
    {
      state: (state: RuntimeState) => log.push(`state ${state.code_id ?? ''}`),
      forces: (paths) => log.push(`forces ${paths.join()}`),
      lost: () => log.push('lost'),
      looked: (cycle, problem) => log.push(`looked ${String(cycle)} ${problem ?? ''}`.trim()),
      paced: (intervalMs) => paces.push(intervalMs),
    },
    environment,
  );
  return { channel, board, sockets, timers, log, paces, elapse };
}

describe('online channel', () => {
  it('subscribes groups when the socket opens, each expression once', () => {
    const { channel, sockets } = setUp();
    channel.watch(['P.a', 'p.A', 'P.b'], 100);
    expect(sockets[0]?.sent).toEqual([]);
    sockets[0]?.accept();
    expect(sockets[0]?.sent).toEqual([{ op: 'subscribe', id: 1, expressions: ['P.a', 'P.b'], interval_ms: 100 }]);
  });

  it('tells the language of the user first, and again when it changes', async () => {
    vi.stubGlobal('document', { documentElement: {} });
    await setLanguage('zh');
    const { channel, sockets } = setUp();
    channel.watch(['P.a'], 100);
    sockets[0]?.accept();
    expect(sockets[0]?.sent.map((message) => (message as { op: string }).op)).toEqual(['speak', 'subscribe']);
    expect(sockets[0]?.sent[0]).toEqual({ op: 'speak', language: 'zh' });
    await setLanguage('en');
    channel.speak();
    expect(sockets[0]?.sent.at(-1)).toEqual({ op: 'speak', language: 'en' });
    vi.unstubAllGlobals();
  });

  it('says when values come at a longer interval than asked for, and when no longer', () => {
    const { channel, sockets, paces } = setUp();
    const socket = sockets[0]!;
    socket.accept();
    channel.watch(['P.a'], 100);
    const large = channel.watch(['P.b'], 100);
    socket.answer(1, ['P.a']);
    socket.answer(2, ['P.b'], 400);
    expect(paces.at(-1)).toBe(400);
    socket.say({ op: 'paced', id: 1, interval_ms: 800 });
    expect(paces.at(-1)).toBe(800);
    large.release();
    expect(paces.at(-1)).toBe(800);
    socket.say({ op: 'paced', id: 1, interval_ms: 100 });
    expect(paces.at(-1)).toBeNull();
  });

  it('ends the old subscription only when the new one is answered', () => {
    const { channel, sockets, board, elapse } = setUp();
    const socket = sockets[0]!;
    socket.accept();
    const group = channel.watch(['P.a'], 100);
    socket.answer(1, ['P.a']);
    group.update(['P.a', 'P.b']);
    group.update(['P.b']);
    expect(socket.sent).toHaveLength(1);
    elapse();
    expect(socket.sent[1]).toMatchObject({ op: 'subscribe', id: 2, expressions: ['P.b'] });
    expect(board.get('P.a')).not.toBeNull();
    socket.answer(2, ['P.b']);
    expect(socket.sent[2]).toEqual({ op: 'unsubscribe', id: 1 });
    expect(board.get('P.a')).toBeNull();
    group.release();
    expect(socket.sent[3]).toEqual({ op: 'unsubscribe', id: 2 });
  });

  it('reconnects with growing pauses and subscribes again; values stay meanwhile', () => {
    const { channel, sockets, log, timers, board, elapse } = setUp();
    sockets[0]?.accept();
    channel.watch(['P.a'], 100);
    sockets[0]?.answer(1, ['P.a']);
    sockets[0]?.drop();
    expect(log).toEqual(['lost']);
    expect(board.get('P.a')).not.toBeNull();
    expect(timers[0]?.ms).toBe(500);
    elapse();
    sockets[1]?.drop();
    expect(timers[0]?.ms).toBe(1000);
    expect(log).toEqual(['lost']);
    elapse();
    sockets[2]?.accept();
    expect(log).toEqual(['lost']);
    expect(sockets[2]?.sent[0]).toMatchObject({ op: 'subscribe', expressions: ['P.a'] });
  });

  it('shows only frames of the time that the server has turned to', () => {
    const { channel, sockets, board, log } = setUp();
    const socket = sockets[0]!;
    socket.accept();
    channel.watch(['P.a'], 100);
    socket.answer(1, ['P.a']);
    const frame = (flags: number, cycle: number, value: number) => {
      const bytes = new Uint8Array(25);
      const view = new DataView(bytes.buffer);
      view.setUint32(0, 1, true);
      view.setUint32(4, flags, true);
      view.setBigUint64(8, BigInt(cycle), true);
      bytes[24] = value;
      socket.onmessage?.({ data: bytes.buffer });
    };
    const value = () => board.get('P.a')?.value;
    frame(0, 900, 1);
    expect(value()).toBe(true);
    channel.lookBack(700);
    expect(socket.sent.at(-1)).toEqual({ op: 'look_back', cycle: 700 });
    socket.say({ op: 'looked_back', cycle: 700, problem: null });
    frame(0, 901, 1);
    frame(1, 699, 1);
    frame(1, 700, 0);
    expect(value()).toBe(false);
    frame(0, 902, 1);
    frame(1, 699, 1);
    expect(value()).toBe(false);
    socket.say({ op: 'looked_back', cycle: null, problem: null });
    frame(1, 700, 0);
    frame(0, 903, 1);
    expect(value()).toBe(true);
    frame(1, 700, 0);
    expect(value()).toBe(true);
    socket.say({ op: 'looked_back', cycle: null, problem: 'cycle 5 is not kept' });
    expect(log).toEqual(['looked 700', 'looked null', 'looked null cycle 5 is not kept']);
  });

  it('shows live values again after a lost connection', () => {
    const { channel, sockets, board, elapse } = setUp();
    sockets[0]?.accept();
    channel.watch(['P.a'], 100);
    sockets[0]?.answer(1, ['P.a']);
    sockets[0]?.say({ op: 'looked_back', cycle: 700, problem: null });
    sockets[0]?.drop();
    elapse();
    sockets[1]?.accept();
    sockets[1]?.answer(2, ['P.a']);
    const bytes = new Uint8Array(25);
    new DataView(bytes.buffer).setUint32(0, 2, true);
    bytes[24] = 1;
    sockets[1]?.onmessage?.({ data: bytes.buffer });
    expect(board.get('P.a')?.value).toBe(true);
  });

  it('takes a new layout for the same subscription after a download', () => {
    const { channel, sockets, board, log } = setUp();
    const socket = sockets[0]!;
    socket.accept();
    channel.watch(['P.a', 'P.b'], 100);
    socket.answer(1, ['P.a', 'P.b']);
    expect(board.get('P.b')?.item.offset).toBe(1);
    socket.answer(1, ['P.b', 'P.a']);
    expect(board.get('P.b')?.item.offset).toBe(0);
    expect(socket.sent).toHaveLength(1);
    socket.say({ op: 'state', code_id: 'c2' });
    socket.say({ op: 'forces', expressions: ['P.a'] });
    expect(log).toEqual(['state c2', 'forces P.a']);
  });

  it('is silent after it was closed', () => {
    const { channel, sockets, timers, log } = setUp();
    sockets[0]?.accept();
    channel.close();
    sockets[0]?.drop();
    expect(timers).toEqual([]);
    expect(log).toEqual([]);
  });
});
