/** JSON-RPC 2.0 on one connection, one message a text frame; requests are answered, cancelled or fail with its end. */

export class RpcError extends Error {
  constructor(
    readonly code: number,
    message: string,
  ) {
    super(message);
    this.name = 'RpcError';
  }
}

interface Waiting {
  resolve: (result: unknown) => void;
  reject: (error: Error) => void;
}

interface Message {
  id?: number | string | null;
  method?: string;
  params?: unknown;
  result?: unknown;
  error?: { code: number; message: string };
}

type NotificationHandler = (params: never) => void;

const METHOD_NOT_FOUND = -32601;
const REQUEST_CANCELLED = -32800;

export class RpcConnection {
  private nextId = 1;
  private ended = false;
  private readonly waiting = new Map<number, Waiting>();
  private readonly handlers = new Map<string, NotificationHandler>();

  /** `post` answers false where the connection is gone. */
  constructor(private readonly post: (message: unknown) => boolean) {}

  on<Params>(method: string, handler: (params: Params) => void): void {
    this.handlers.set(method, handler);
  }

  notify(method: string, params: unknown): void {
    this.send({ method, params });
  }

  /** Rejects with RpcError when the server refuses, the socket breaks or the request is cancelled. */
  request<Result>(method: string, params: unknown, cancelled?: (cancel: () => void) => void): Promise<Result> {
    return new Promise<Result>((resolve, reject) => {
      const id = this.nextId++;
      if (this.ended || !this.send({ id, method, params })) {
        reject(new RpcError(0, 'The language server is not connected'));
        return;
      }
      this.waiting.set(id, { resolve: resolve as (result: unknown) => void, reject });
      cancelled?.(() => {
        if (!this.waiting.delete(id)) return;
        this.notify('$/cancelRequest', { id });
        reject(new RpcError(REQUEST_CANCELLED, 'Cancelled'));
      });
    });
  }

  /** The connection is gone: what waits for an answer gets none. */
  end(): void {
    this.ended = true;
    for (const { reject } of this.waiting.values()) reject(new RpcError(0, 'The language server is not connected'));
    this.waiting.clear();
  }

  private send(message: Message): boolean {
    return !this.ended && this.post({ jsonrpc: '2.0', ...message });
  }

  receive(data: unknown): void {
    if (typeof data !== 'string') return;
    const message = JSON.parse(data) as Message;
    if (message.method !== undefined && message.id != null) this.refuse(message);
    else if (message.method !== undefined) this.handlers.get(message.method)?.(message.params as never);
    else if (typeof message.id === 'number') this.answer(message.id, message);
  }

  /** The server may ask for configuration or register capabilities: null is a lawful answer to both. */
  private refuse(message: Message): void {
    const known = ['workspace/configuration', 'client/registerCapability', 'window/workDoneProgress/create'];
    const id = message.id as number;
    if (known.includes(message.method ?? '')) this.send({ id, result: null });
    else this.send({ id, error: { code: METHOD_NOT_FOUND, message: `unknown method ${message.method ?? ''}` } });
  }

  private answer(id: number, message: Message): void {
    const waiting = this.waiting.get(id);
    if (waiting === undefined) return;
    this.waiting.delete(id);
    if (message.error !== undefined) waiting.reject(new RpcError(message.error.code, message.error.message));
    else waiting.resolve(message.result);
  }
}
