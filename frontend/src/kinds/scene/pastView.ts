/** A scene's own view of the past: it is opened at the first cycle and follows the time bar from then on. */

export interface PastViewState {
  /** Address of the view, null before it is opened. */
  readonly path: string | null;
  /** Why the wanted cycle is not shown. */
  readonly error: unknown;
}

/** What the server does; tests have their own. */
export interface PastServer {
  /** Opens a view that stands in a cycle; its address. */
  open: (cycle: number) => Promise<string>;
  move: (path: string, cycle: number) => Promise<unknown>;
  /** Whether the view is gone, so that another one has to be opened. */
  gone: (error: unknown) => boolean;
}

/** One question is under way at a time; the latest cycle that was wanted meanwhile comes next. */
export class PastView {
  private state: PastViewState = { path: null, error: null };
  private asked: number | null = null;
  private wanted: number | null = null;
  private closed = false;

  constructor(
    private readonly server: PastServer,
    private readonly changed: (state: PastViewState) => void,
  ) {}

  show(cycle: number): void {
    this.wanted = cycle;
    if (this.asked === null) void this.ask();
  }

  close(): void {
    this.closed = true;
  }

  private async ask(): Promise<void> {
    while (this.wanted !== null && !this.closed) {
      const cycle = (this.asked = this.wanted);
      this.wanted = null;
      try {
        this.set({ path: await this.reach(cycle), error: null });
      } catch (error) {
        this.set({ ...this.state, error });
      }
    }
    this.asked = null;
  }

  private async reach(cycle: number): Promise<string> {
    const { path } = this.state;
    if (path !== null) {
      try {
        await this.server.move(path, cycle);
        return path;
      } catch (error) {
        if (!this.server.gone(error)) throw error;
      }
    }
    return this.server.open(cycle);
  }

  private set(state: PastViewState): void {
    if (this.closed) return;
    const same = state.path === this.state.path && state.error === this.state.error;
    this.state = state;
    if (!same) this.changed(state);
  }
}
