import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import type { Monaco } from '@/text/monacoLoader';
import { LanguageClient } from './client';

/** A socket whose other end is the test. */
class Socket {
  static made: Socket[] = [];
  binaryType = '';
  readyState = 0;
  onopen: (() => void) | null = null;
  onclose: (() => void) | null = null;
  onmessage: ((event: { data: string }) => void) | null = null;
  readonly sent: { id?: number; method: string }[] = [];

  constructor(readonly url: string) {
    Socket.made.push(this);
  }
  send(text: string): void {
    this.sent.push(JSON.parse(text) as Socket['sent'][number]);
  }
  close(): void {
    this.readyState = 3;
  }
  opens(): void {
    this.readyState = 1;
    this.onopen?.();
  }
  answers(id: number, result: unknown): void {
    this.onmessage?.({ data: JSON.stringify({ jsonrpc: '2.0', id, result }) });
  }
}

const nothing = { dispose: () => undefined };
const monaco = {
  editor: { onDidCreateModel: () => nothing, onWillDisposeModel: () => nothing, getModels: () => [] },
} as unknown as Monaco;
const settled = () => new Promise((resolve) => setTimeout(resolve));

beforeEach(() => {
  Socket.made = [];
  vi.stubGlobal('WebSocket', Socket);
  vi.stubGlobal('location', new URL('http://tappet.test/#/'));
});
afterEach(() => vi.unstubAllGlobals());

it('answers over the connection that took the place of one that was still beginning', async () => {
  const client = new LanguageClient(
    monaco,
    'p',
    () => undefined,
    () => undefined,
  );
  Socket.made[0]!.opens();
  client.renew();
  await settled(); // what the first connection waited for has failed
  Socket.made[1]!.opens();
  Socket.made[1]!.answers(1, { capabilities: {} });
  await settled();
  const symbols = client.request('workspace/symbol', { query: '' });
  await settled();
  const asked = Socket.made[1]!.sent.at(-1)!;
  expect(asked.method).toBe('workspace/symbol');
  Socket.made[1]!.answers(asked.id!, ['PLC_PRG']);
  expect(await symbols).toEqual(['PLC_PRG']);
  client.close();
});
