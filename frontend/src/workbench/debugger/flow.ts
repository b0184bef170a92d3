/**
 * Flow control: the controller records which statements of the bodies on screen each cycle executes, and the values
 * right after each of them. It records for this page while the page asks.
 */
import { create } from 'zustand';
import { api, ApiError } from '@/api/client';
import type { FlowSnapshot } from '@/api/types';
import { notifyError } from '@/ui/notices';
import { compiled } from './acts';

type Snapshots = Readonly<Record<string, FlowSnapshot>>;

interface FlowState {
  /** What has been read, by object, of each runtime with flow control. */
  readonly runtimes: Readonly<Record<string, Snapshots>>;
}

export const useFlow = create<FlowState>(() => ({ runtimes: {} }));

const POLL_MS = 200;
const LOST_MS = 1000;
const CONFLICT = 409;

export const hasFlow = (runtimeId: string): boolean => runtimeId in useFlow.getState().runtimes;

/** Objects whose bodies are on screen, by runtime, and in how many editors. */
const onScreen = new Map<string, Map<string, number>>();
const recorders = new Map<string, FlowRecorder>();

/** The body of an object is on screen until what is answered is called. */
export function bodyShown(runtimeId: string, objectId: string): () => void {
  const shown = onScreen.get(runtimeId) ?? new Map<string, number>();
  onScreen.set(runtimeId, shown);
  shown.set(objectId, (shown.get(objectId) ?? 0) + 1);
  recorders.get(runtimeId)?.changed();
  return () => {
    const left = (shown.get(objectId) ?? 0) - 1;
    if (left > 0) shown.set(objectId, left);
    else shown.delete(objectId);
    recorders.get(runtimeId)?.changed();
  };
}

export function switchFlow(runtimeId: string, on: boolean): void {
  if (on === hasFlow(runtimeId)) return;
  if (on) {
    useFlow.setState(({ runtimes }) => ({ runtimes: { ...runtimes, [runtimeId]: {} } }));
    const recorder = new FlowRecorder(runtimeId);
    recorders.set(runtimeId, recorder);
    void recorder.run();
  } else {
    recorders.get(runtimeId)?.end();
    recorders.delete(runtimeId);
    useFlow.setState(({ runtimes }) => {
      const { [runtimeId]: _off, ...others } = runtimes;
      return { runtimes: others };
    });
  }
}

/** Asks one runtime, one question after the other. */
class FlowRecorder {
  private ended = false;
  /** What the controller was told to record. */
  private held = '';
  /** By which the controller knows again who asks. */
  private readonly holder = `page ${performance.timeOrigin.toString(36)} ${Math.random().toString(36).slice(2)}`;
  private wake: () => void = () => undefined;

  constructor(private readonly runtimeId: string) {}

  changed(): void {
    this.wake();
  }

  end(): void {
    this.ended = true;
    this.wake();
  }

  async run(): Promise<void> {
    while (!this.ended) {
      const objects = [...(onScreen.get(this.runtimeId)?.keys() ?? [])].sort();
      try {
        await this.hold(objects);
        await this.read(objects);
        await this.pause(POLL_MS);
      } catch (error) {
        if (!(error instanceof ApiError)) throw error;
        if (error.status !== 0 && error.status < 500) {
          notifyError(error);
          switchFlow(this.runtimeId, false);
        } else await this.pause(LOST_MS);
      }
    }
    // A controller that cannot be told lets go by itself.
    await this.hold([]).catch(() => undefined);
  }

  private async hold(objects: readonly string[]): Promise<void> {
    const wanted = objects.join(' ');
    if (wanted === this.held) return;
    const order = {
      params: { path: { runtime_id: this.runtimeId } },
      body: { object_ids: [...objects], holder: this.holder },
    };
    const put = () => api.put('/api/v1/runtimes/{runtime_id}/debug/flow', order);
    await (objects.length > 0 ? compiled(this.runtimeId, put) : put());
    this.held = wanted;
  }

  private async read(objects: readonly string[]): Promise<void> {
    try {
      const read = await Promise.all(objects.map((objectId) => this.snapshot(objectId)));
      if (this.ended) return;
      useFlow.setState(({ runtimes }) => ({
        runtimes: { ...runtimes, [this.runtimeId]: Object.fromEntries(read.map((one) => [one.object_id, one])) },
      }));
    } catch (error) {
      if (!(error instanceof ApiError) || error.status !== CONFLICT) throw error;
      this.held = ''; // after a download, or a long silence: it is told again
    }
  }

  private snapshot(objectId: string): Promise<FlowSnapshot> {
    const params = { path: { runtime_id: this.runtimeId }, query: { object_id: objectId, holder: this.holder } };
    return api.get('/api/v1/runtimes/{runtime_id}/debug/flow', { params });
  }

  /** Waits; without an end while nothing is on screen. */
  private pause(milliseconds: number): Promise<void> {
    if (this.ended) return Promise.resolve();
    const forEver = (onScreen.get(this.runtimeId)?.size ?? 0) === 0 && this.held === '';
    return new Promise((resolve) => {
      const timer = forEver ? undefined : setTimeout(resolve, milliseconds);
      this.wake = () => {
        clearTimeout(timer);
        resolve();
      };
    });
  }
}
