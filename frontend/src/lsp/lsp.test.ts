import { describe, expect, it } from 'vitest';
import {
  applyTextEdits,
  fromCompletion,
  fromDiagnostic,
  fromMarkup,
  parseLibraryUri,
  toRange,
  toneOf,
} from './convert';
import { parsePartUri } from '@/project/partUri';
import { RpcConnection, RpcError } from './rpc';

/** A connection whose server is the test. */
function connection() {
  const sent: unknown[] = [];
  const rpc = new RpcConnection((message) => sent.push(message) > 0);
  const say = (message: object) => rpc.receive(JSON.stringify({ jsonrpc: '2.0', ...message }));
  return { rpc, sent, say };
}

describe('json rpc', () => {
  it('pairs answers with requests, whatever their order', async () => {
    const { rpc, say } = connection();
    const first = rpc.request<string>('a', {});
    const second = rpc.request<string>('b', {});
    say({ id: 2, result: 'B' });
    say({ id: 1, error: { code: -32602, message: 'wrong' } });
    expect(await second).toBe('B');
    await expect(first).rejects.toThrow('wrong');
  });
  it('cancels, and fails what waits when the connection ends', async () => {
    const { rpc, sent } = connection();
    let cancel = () => undefined as void;
    const cancelled = rpc.request('a', {}, (act) => (cancel = act));
    const broken = rpc.request('b', {});
    cancel();
    expect(sent.at(-1)).toMatchObject({ method: '$/cancelRequest', params: { id: 1 } });
    await expect(cancelled).rejects.toBeInstanceOf(RpcError);
    rpc.end();
    await expect(broken).rejects.toBeInstanceOf(RpcError);
    await expect(rpc.request('c', {})).rejects.toBeInstanceOf(RpcError);
  });
  it('hands notifications over and answers the questions of the server', () => {
    const { rpc, sent, say } = connection();
    const heard: unknown[] = [];
    rpc.on('x/y', (params: unknown) => heard.push(params));
    say({ method: 'x/y', params: { a: 1 } });
    expect(heard).toEqual([{ a: 1 }]);
    say({ id: 7, method: 'workspace/configuration', params: {} });
    say({ id: 8, method: 'foo/bar', params: {} });
    expect(sent).toEqual([
      { jsonrpc: '2.0', id: 7, result: null },
      { jsonrpc: '2.0', id: 8, error: { code: -32601, message: 'unknown method foo/bar' } },
    ]);
  });
});

describe('conversions', () => {
  const range = { start: { line: 2, character: 4 }, end: { line: 2, character: 4 } };
  it('count from one in the editor', () => {
    const marker = fromDiagnostic({
      range,
      severity: 2,
      code: 'W1001',
      message: 'unused',
      data: { advice: 'remove it' },
    });
    expect(marker).toMatchObject({
      startLineNumber: 3, startColumn: 5, endLineNumber: 3, endColumn: 6, severity: 4, code: 'W1001', message: 'unused\nremove it',
    }); // prettier-ignore
    expect(toRange({ startLineNumber: 3, startColumn: 5, endLineNumber: 3, endColumn: 6 }).start).toEqual(range.start);
  });
  it('turn completions into suggestions', () => {
    const word = { startLineNumber: 1, startColumn: 1, endLineNumber: 1, endColumn: 3 };
    expect(fromCompletion({ label: 'TON', kind: 7, insertText: 'TON($1)', insertTextFormat: 2 }, word, 4)).toMatchObject({
      label: 'TON', kind: 5, insertText: 'TON($1)', insertTextRules: 4, range: word,
    }); // prettier-ignore
  });
  it('keep plain text plain', () => {
    expect(fromMarkup({ kind: 'plaintext', value: 'a_b*c' }).value).toBe('a\\_b\\*c');
    expect(fromMarkup({ language: 'iec-st', value: 'x' }).value).toContain('```iec-st');
  });
  it('apply edits to closed texts', () => {
    const edit = (line: number, from: number, to: number, newText: string) => ({
      range: { start: { line, character: from }, end: { line, character: to } },
      newText,
    });
    expect(applyTextEdits('ab\ncd\n', [edit(0, 0, 1, 'X'), edit(1, 1, 2, 'Y'), edit(2, 0, 0, 'end')])).toBe(
      'Xb\ncY\nend',
    );
  });
  it('read addresses', () => {
    expect(parsePartUri('tappet:/p1/o1/declaration')).toEqual({ projectId: 'p1', objectId: 'o1', part: 'declaration' });
    expect(parsePartUri('file:///x.st')).toBeNull();
  });
});

describe('addresses of library texts', () => {
  it('name the library and the item, also for a method of it', () => {
    expect(parseLibraryUri('tappet-library:/Standard/TON')).toEqual({ library: 'Standard', item: 'TON' });
    expect(parseLibraryUri('tappet-library:/My%20Lib/FB_A.Start')).toEqual({ library: 'My Lib', item: 'FB_A' });
    expect(parseLibraryUri('tappet:/p/o/declaration')).toBeNull();
  });
});

describe('what the server says to people', () => {
  it('reaches who listens, and is as urgent as it says', () => {
    const { rpc, say } = connection();
    const heard: string[] = [];
    rpc.on<{ type: number; message: string }>('window/showMessage', (said) =>
      heard.push(`${toneOf(said)} ${said.message}`),
    );
    say({ method: 'window/showMessage', params: { type: 1, message: 'ended' } });
    say({ method: 'window/showMessage', params: { type: 2, message: 'slow' } });
    say({ method: 'window/showMessage', params: { type: 3, message: 'ready' } });
    expect(heard).toEqual(['error ended', 'warn slow', 'info ready']);
  });
});
