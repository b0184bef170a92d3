import { describe, expect, it } from 'vitest';
import { FakeSocket, fakeSockets } from '../../tests/fakeSocket';
import { FIRST_PAUSE_MS, LONGEST_PAUSE_MS, ReconnectingSocket } from './socket';

function setUp(random = 0.5) {
  const fakes = fakeSockets(() => new FakeSocket());
  const log: string[] = [];
  const socket = new ReconnectingSocket(
    'ws://host/x',
    {
      opened: (again) => log.push(again ? 'opened again' : 'opened'),
      message: (data) => log.push(`message ${String(data)}`),
      lost: () => log.push('lost'),
      stateChanged: (state) => log.push(`[${state}]`),
    },
    { ...fakes.environment, random: () => random },
  );
  return { socket, log, ...fakes };
}

describe('a reconnecting socket', () => {
  it('connects, passes messages on, and reports its state', () => {
    const { socket, sockets, log } = setUp();
    expect(socket.send({ op: 'early' })).toBe(false);
    sockets[0]!.accept();
    sockets[0]!.say({ a: 1 });
    expect(socket.send({ op: 'now' })).toBe(true);
    expect(sockets[0]!.sent).toEqual([{ op: 'now' }]);
    expect(log).toEqual(['[connecting]', '[open]', 'opened', 'message {"a":1}']);
  });

  it('connects again after a loss and says so to whoever subscribes', () => {
    const { sockets, log, elapse } = setUp();
    sockets[0]!.accept();
    sockets[0]!.drop();
    elapse();
    sockets[1]!.accept();
    expect(log).toEqual([
      '[connecting]', '[open]', 'opened', '[waiting]', 'lost', '[connecting]', '[open]', 'opened again',
    ]); // prettier-ignore
  });

  it('waits longer each time up to a limit, and shortly again once the server has answered', () => {
    const { sockets, timers, elapse } = setUp();
    const pauses: number[] = [];
    for (let round = 0; round < 8; round++) {
      // Accepted and closed at once, as a server does that refuses: that is no success.
      sockets.at(-1)!.accept();
      sockets.at(-1)!.drop();
      pauses.push(timers[0]!.ms);
      elapse();
    }
    expect(pauses.slice(0, 4)).toEqual([1, 2, 4, 8].map((times) => times * FIRST_PAUSE_MS));
    expect(pauses.at(-1)).toBe(LONGEST_PAUSE_MS);
    sockets.at(-1)!.accept();
    sockets.at(-1)!.say('hello');
    sockets.at(-1)!.drop();
    expect(timers[0]!.ms).toBe(FIRST_PAUSE_MS);
  });

  it('scatters its pauses by a quarter', () => {
    for (const [random, times] of [[0, 0.75], [1, 1.25]] as const) {
      const { sockets, timers } = setUp(random);
      sockets[0]!.drop();
      expect(timers[0]!.ms).toBe(times * FIRST_PAUSE_MS);
    }
  }); // prettier-ignore

  it('reports a loss once, however often it fails to connect', () => {
    const { sockets, log, elapse } = setUp();
    for (let round = 0; round < 3; round++) {
      sockets.at(-1)!.drop();
      elapse();
    }
    expect(log.filter((line) => line === 'lost')).toHaveLength(1);
  });

  it('is renewed at once, and hears nothing more of the old connection', () => {
    const { socket, sockets, log } = setUp();
    sockets[0]!.accept();
    socket.renew();
    expect(sockets).toHaveLength(2);
    expect(sockets[0]!.readyState).toBe(3);
    sockets[0]!.say('late');
    sockets[0]!.drop();
    sockets[1]!.accept();
    expect(log.slice(3)).toEqual(['lost', '[connecting]', '[open]', 'opened again']);
  });

  it('stays closed', () => {
    const { socket, sockets, timers, elapse } = setUp();
    sockets[0]!.drop();
    socket.close();
    expect(timers).toEqual([]);
    elapse();
    socket.renew();
    expect(sockets).toHaveLength(1);
    expect(socket.state).toBe('closed');
  });
});
