/**
 * The language client of the open project: one connection, kept up, and every model of an IEC text on it.
 *
 * A thin layer: it mirrors the models to the server and shows what the server publishes. The providers ask through it.
 */
import type { CancellationToken, editor, IDisposable } from 'monaco-editor/editor/editor.api';
import { socketUrl } from '@/api/client';
import { ReconnectingSocket } from '@/api/socket';
import { IEC_TEXT } from '@/text/iecText';
import { textLanguages } from '@/text/languages';
import type { Monaco } from '@/text/monacoLoader';
import { language } from '@/i18n';
import { fromDiagnostic, toRange } from './convert';
import { parsePartUri } from '@/project/partUri';
import type { Diagnostic, InitializeResult, ServerCapabilities, ShownMessage } from './protocol';
import { RpcConnection, RpcError } from './rpc';

const INCREMENTAL = 2;
const MARKERS = 'tappet';

const CLIENT_CAPABILITIES = {
  general: { positionEncodings: ['utf-16'] },
  textDocument: {
    synchronization: { dynamicRegistration: false },
    completion: {
      completionItem: {
        snippetSupport: true,
        documentationFormat: ['markdown', 'plaintext'],
        labelDetailsSupport: true,
      },
    },
    hover: { contentFormat: ['markdown', 'plaintext'] },
    signatureHelp: {
      signatureInformation: { parameterInformation: { labelOffsetSupport: true }, activeParameterSupport: true },
    },
    codeAction: {
      codeActionLiteralSupport: { codeActionKind: { valueSet: ['quickfix'] } },
      isPreferredSupport: true,
      dataSupport: true,
    },
    documentSymbol: { hierarchicalDocumentSymbolSupport: true },
    publishDiagnostics: { relatedInformation: true, dataSupport: true, tagSupport: { valueSet: [1, 2] } },
    rename: { prepareSupport: true },
    semanticTokens: {
      requests: { full: true },
      tokenTypes: [
        'namespace', 'type', 'class', 'enum', 'interface', 'struct', 'parameter', 'variable', 'property', 'enumMember',
        'function', 'method', 'macro', 'keyword', 'comment', 'string', 'number', 'operator',
      ], // prettier-ignore
      tokenModifiers: ['declaration', 'readonly', 'static', 'deprecated', 'defaultLibrary'],
      formats: ['relative'],
    },
  },
};

export class LanguageClient {
  capabilities: ServerCapabilities = {};
  private rpc: RpcConnection | null = null;
  /** Settles with the connection once it is initialised, with null where there is none. */
  private ready: Promise<RpcConnection | null> = Promise.resolve(null);
  private settle: (rpc: RpcConnection | null) => void = () => undefined;
  private readonly socket: ReconnectingSocket;
  private readonly disposables: IDisposable[] = [];
  private readonly listeners = new Map<string, IDisposable>();
  private readonly connectedListeners = new Set<() => void>();

  constructor(
    private readonly monaco: Monaco,
    readonly projectId: string,
    /** Hears what the server finds in a text that is open. */
    private readonly published: (uri: string, diagnostics: readonly Diagnostic[]) => void,
    /** Hears what the server says to people, such as that the analysis has ended. */
    private readonly said: (message: ShownMessage) => void,
  ) {
    this.disposables.push(
      monaco.editor.onDidCreateModel((model) => this.watch(model)),
      monaco.editor.onWillDisposeModel((model) => this.forget(model)),
    );
    this.socket = new ReconnectingSocket(socketUrl('/lsp', { project: projectId }), {
      opened: () => this.start(),
      message: (data) => this.rpc?.receive(data),
      stateChanged: (state) => {
        if (state !== 'open') this.lost();
        if (state === 'connecting') this.ready = new Promise((resolve) => (this.settle = resolve));
      },
    });
    for (const model of monaco.editor.getModels()) this.watch(model);
  }

  /** Called after each successful connection, when the server's capabilities are known. */
  onConnected(listener: () => void): () => void {
    this.connectedListeners.add(listener);
    return () => this.connectedListeners.delete(listener);
  }

  /** Null where the server cannot answer now or the request was cancelled; the editor then shows nothing. */
  async request<Result>(method: string, params: unknown, token?: CancellationToken): Promise<Result | null> {
    let subscription: IDisposable | undefined;
    try {
      const rpc = await this.ready;
      if (rpc === null || token?.isCancellationRequested === true) return null;
      return await rpc.request<Result>(method, params, (cancel) => {
        subscription = token?.onCancellationRequested(cancel);
      });
    } catch (error) {
      if (error instanceof RpcError) return null;
      throw error;
    } finally {
      subscription?.dispose();
    }
  }

  /** As `request`, but a refusal reaches the caller with the server's words (rename). */
  async demand<Result>(method: string, params: unknown): Promise<Result> {
    const rpc = await this.ready;
    if (rpc === null) throw new RpcError(0, 'The language server is not connected');
    return rpc.request<Result>(method, params);
  }

  /** Sends the server a notification now, if it is connected. */
  notify(method: string, params: unknown): void {
    void this.ready.then((rpc) => rpc?.notify(method, params));
  }

  /** Connects again: the server writes its messages in the language given at initialisation. */
  renew(): void {
    this.socket.renew();
  }

  close(): void {
    this.disposables.forEach((disposable) => disposable.dispose());
    this.listeners.forEach((listener) => listener.dispose());
    this.socket.close();
  }

  private start(): void {
    const rpc = new RpcConnection((message) => this.socket.send(message));
    this.rpc = rpc;
    rpc.on<{ uri: string; diagnostics: Diagnostic[] }>('textDocument/publishDiagnostics', (p) =>
      this.diagnostics(p.uri, p.diagnostics),
    );
    rpc.on<ShownMessage>('window/showMessage', (message) => this.said(message));
    const { settle } = this; // of this connection: it may fail when the next one has begun
    this.initialise(rpc).then(
      () => settle(rpc),
      () => settle(null),
    );
  }

  private async initialise(rpc: RpcConnection): Promise<void> {
    const result = await rpc.request<InitializeResult>('initialize', {
      processId: null,
      clientInfo: { name: 'Tappet' },
      locale: language(),
      rootUri: `tappet:/${this.projectId}`,
      capabilities: CLIENT_CAPABILITIES,
    });
    this.capabilities = result.capabilities;
    rpc.notify('initialized', {});
    for (const model of this.models()) this.open(rpc, model);
    this.connectedListeners.forEach((listener) => listener());
  }

  /** What waits for an answer gets none; requests fail until there is a connection again. */
  private lost(): void {
    this.rpc?.end();
    this.rpc = null;
    this.settle(null);
  }

  private mine(model: editor.ITextModel): boolean {
    return (
      textLanguages().includes(model.getLanguageId()) &&
      parsePartUri(model.uri.toString())?.projectId === this.projectId
    );
  }

  private models(): editor.ITextModel[] {
    return this.monaco.editor.getModels().filter((model) => this.mine(model));
  }

  private watch(model: editor.ITextModel): void {
    if (!this.mine(model)) return;
    const uri = model.uri.toString();
    if (this.listeners.has(uri)) return;
    this.listeners.set(
      uri,
      model.onDidChangeContent((event) => this.changed(model, event)),
    );
    void this.ready.then((rpc) => {
      if (rpc !== null && !model.isDisposed()) this.open(rpc, model);
    });
  }

  private readonly opened = new WeakMap<RpcConnection, Set<string>>();

  private open(rpc: RpcConnection, model: editor.ITextModel): void {
    const uri = model.uri.toString();
    const known = this.opened.get(rpc) ?? new Set<string>();
    this.opened.set(rpc, known);
    if (known.has(uri)) return;
    known.add(uri);
    rpc.notify('textDocument/didOpen', {
      textDocument: { uri, languageId: IEC_TEXT, version: model.getVersionId(), text: model.getValue() },
    });
  }

  private changed(model: editor.ITextModel, event: editor.IModelContentChangedEvent): void {
    const uri = model.uri.toString();
    if (this.rpc === null || this.opened.get(this.rpc)?.has(uri) !== true) return;
    const sync = this.capabilities.textDocumentSync;
    const incremental = (typeof sync === 'object' ? sync.change : sync) === INCREMENTAL && !event.isFlush;
    this.rpc.notify('textDocument/didChange', {
      textDocument: { uri, version: event.versionId },
      contentChanges: incremental
        ? event.changes.map((change) => ({ range: toRange(change.range), text: change.text }))
        : [{ text: model.getValue() }],
    });
  }

  private forget(model: editor.ITextModel): void {
    const uri = model.uri.toString();
    this.listeners.get(uri)?.dispose();
    if (!this.listeners.delete(uri) || this.rpc === null) return;
    this.opened.get(this.rpc)?.delete(uri);
    this.rpc.notify('textDocument/didClose', { textDocument: { uri } });
  }

  private diagnostics(uri: string, diagnostics: readonly Diagnostic[]): void {
    const model = this.monaco.editor.getModel(this.monaco.Uri.parse(uri));
    if (model === null) return;
    this.monaco.editor.setModelMarkers(model, MARKERS, diagnostics.map(fromDiagnostic));
    this.published(uri, diagnostics);
  }
}
