/**
 * The worker in which one run of a script happens. It offers `tappet`, takes away what reaches other places, and then
 * imports the script as a module.
 *
 * The server sends this file with a policy of its own (`server/static.py`): modules from blobs alone, no connections.
 * The browser holds a script to it whatever the script finds in its scope; what is taken away here is taken away so
 * that a script which tries it is told so.
 */
import type { FromWorker, OutputLine, Query, ScriptFacts, ScriptFailure, Tone, ToWorker, Verb } from './protocol';

const GONE = [
  'fetch', 'XMLHttpRequest', 'WebSocket', 'WebSocketStream', 'WebTransport', 'EventSource', 'importScripts', 'Worker',
  'SharedWorker', 'BroadcastChannel', 'indexedDB', 'caches', 'Notification', 'postMessage', 'close', 'onmessage',
]; // prettier-ignore
const MOST_WAITING = 5000;
const LONGEST_LINE = 4000;
const FLUSH_MS = 40;

/** A request that the server, or the workbench, has refused. */
class RequestError extends Error {
  constructor(
    message: string,
    readonly status: number,
    stack: string | undefined,
  ) {
    super(message);
    this.name = 'RequestError';
    // Of the call, not of the answer: that is a line of the script.
    if (stack !== undefined) this.stack = stack;
  }
}

const post = self.postMessage.bind(self) as (message: FromWorker) => void;
const listen = self.addEventListener.bind(self);
const later = self.setTimeout.bind(self);
const waiting = new Map<
  number,
  { resolve: (data: unknown) => void; refuse: (status: number, message: string) => void }
>();
let serial = 0;
let script = '';

let lines: OutputLine[] = [];
let left = 0;
let flushing = false;

function flush(): void {
  flushing = false;
  if (left > 0) lines.push({ tone: 'warn', text: `… ${String(left)}` });
  if (lines.length > 0) post({ type: 'lines', lines });
  lines = [];
  left = 0;
}

function write(tone: Tone, values: readonly unknown[]): void {
  if (lines.length >= MOST_WAITING) left += 1;
  else lines.push({ tone, text: values.map(written).join(' ').slice(0, LONGEST_LINE) });
  if (flushing) return;
  flushing = true;
  later(flush, FLUSH_MS);
}

function written(value: unknown): string {
  if (typeof value === 'string') return value;
  if (value instanceof Error) return `${value.name}: ${value.message}`;
  try {
    return JSON.stringify(value) ?? String(value);
  } catch {
    return String(value);
  }
}

function request(verb: Verb, path: string, query?: Query, body?: unknown): Promise<unknown> {
  const { stack } = new Error();
  return new Promise((resolve, reject) => {
    const id = (serial += 1);
    waiting.set(id, { resolve, refuse: (status, message) => reject(new RequestError(message, status, stack)) });
    try {
      post({ type: 'request', id, verb, path: String(path), query, body });
    } catch (error) {
      // Functions and the like cannot be sent.
      waiting.delete(id);
      reject(error instanceof Error ? error : new Error(String(error)));
    }
  });
}

function api(facts: ScriptFacts) {
  return Object.freeze({
    ...facts,
    get: (path: string, query?: Query) => request('get', path, query),
    post: (path: string, body?: unknown, query?: Query) => request('post', path, query, body),
    put: (path: string, body?: unknown, query?: Query) => request('put', path, query, body),
    patch: (path: string, body?: unknown, query?: Query) => request('patch', path, query, body),
    delete: (path: string, query?: Query) => request('delete', path, query),
    log: (...values: unknown[]) => write('info', values),
    warn: (...values: unknown[]) => write('warn', values),
    sleep: (milliseconds: number) => new Promise<void>((resolve) => void later(resolve, milliseconds)),
  });
}

/** Takes a name away wherever the scope gets it from. */
function takeAway(name: string): void {
  for (let at: object | null = self; at !== null; at = Object.getPrototypeOf(at) as object | null) {
    if (Object.hasOwn(at, name)) Reflect.deleteProperty(at, name);
  }
  Object.defineProperty(self, name, { value: undefined, writable: false, configurable: false });
}

/** Where in the script an error comes from, by its stack: the place that is nearest to the error. */
function placeIn(stack: string | undefined): { line: number; column: number } | null {
  const at = stack?.indexOf(script) ?? -1;
  const place = at < 0 ? null : /^:(\d+):(\d+)/.exec(stack!.slice(at + script.length));
  return place === null ? null : { line: Number(place[1]), column: Number(place[2]) };
}

function failureOf(error: unknown): ScriptFailure {
  const message = written(error);
  const place = error instanceof Error ? placeIn(error.stack) : null;
  return { message, line: place?.line ?? null, column: place?.column ?? null };
}

/** The browser knows more of an error than its stack tells, such as the place of one of syntax. */
function reported(error: unknown): ScriptFailure {
  const failure = failureOf(error);
  if (failure.line !== null) return failure;
  const look = (event: ErrorEvent) => {
    event.preventDefault();
    event.stopImmediatePropagation();
    if (event.filename !== script || event.lineno < 1) return;
    failure.line = event.lineno;
    failure.column = event.colno;
  };
  listen('error', look, { capture: true, once: true });
  self.reportError(error);
  return failure;
}

async function run(url: string, facts: ScriptFacts): Promise<void> {
  script = url;
  Object.defineProperty(self, 'tappet', { value: api(facts), writable: false, configurable: false });
  const lineOf = (tone: Tone) => (...values: unknown[]) => write(tone, values); // prettier-ignore
  Object.assign(console, {
    log: lineOf('info'), info: lineOf('info'), debug: lineOf('info'), warn: lineOf('warn'), error: lineOf('error'),
  }); // prettier-ignore
  GONE.forEach(takeAway);
  try {
    await import(/* @vite-ignore */ url);
    flush();
    post({ type: 'done' });
  } catch (error) {
    const failure = reported(error);
    flush();
    post({ type: 'failed', ...failure });
  }
}

listen('message', ({ data }: MessageEvent<ToWorker>) => {
  if (data.type === 'start') {
    void run(data.url, data.facts);
    return;
  }
  const request = waiting.get(data.id);
  waiting.delete(data.id);
  if (data.type === 'answer') request?.resolve(data.data);
  else request?.refuse(data.status, data.message);
});
listen('error', (event: ErrorEvent) => {
  event.preventDefault();
  const here = event.filename === script && event.lineno > 0;
  post({
    type: 'stray',
    message: event.message,
    line: here ? event.lineno : null,
    column: here ? event.colno : null,
  });
});
listen('unhandledrejection', (event: PromiseRejectionEvent) => {
  event.preventDefault();
  post({ type: 'stray', ...failureOf(event.reason) });
});
