/**
 * Bounds what a 3D view in a frame takes of the workbench around it.
 *
 * Both share one main thread and, where there is no graphics processor, the same few cores. A picture that is quick is
 * left alone, at 30 a second. After one that holds the page up the view rests three times as long, is drawn with
 * fewer pixels, and waits while the user types, clicks or scrolls in the workbench. A view that nobody sees is not drawn.
 */

/** What is needed of the window of the view; tests have their own. */
export interface ViewWindow {
  requestAnimationFrame: (callback: FrameRequestCallback) => number;
  cancelAnimationFrame: (id: number) => void;
  /** viser's own settings of its page, as its tests reach them. */
  __viserTestpoints?: { devSettings?: { set?: (settings: { fixedDpr: number | null }) => void } };
}

export interface FrameClock {
  now: () => number;
  after: (ms: number, callback: () => void) => () => void;
  /** Whether the user works with this window. */
  focused: () => boolean;
}

/** At most 30 pictures a second. */
const PICTURE_MS = 33;
/** A page that gets its second next frame within this time is not held up; at 60 Hz it takes 33 ms. */
const QUICK_MS = 60;
const REST = 3;
const LONGEST_REST_MS = 2000;
/** Slow pictures wait this long after a key, a click or a turn of the wheel in the workbench. */
const INPUT_MS = 400;
/** Between two pictures while another window has the focus. */
const UNFOCUSED_MS = 500;
/** How often is looked at what a picture costs. */
const LOOK_MS = 1000;
/** Device pixels a CSS pixel of a view that stays slow: the first pictures always are. */
const FEW_PIXELS = 0.5;
const STAYS_SLOW = 3;

export class FrameLimit {
  private readonly request: ViewWindow['requestAnimationFrame'];
  private waiting = new Map<number, FrameRequestCallback>();
  private last = 0;
  private scheduled = false;
  private cancelTimer: (() => void) | null = null;
  private restUntil = 0;
  private lookedAt = -Infinity;
  private looking = false;
  /** Slow pictures one after the other. */
  private slow = 0;
  private paused = false;

  /** Takes the place of the window's own frames from now on. */
  constructor(
    private readonly view: ViewWindow,
    private readonly clock: FrameClock = BROWSER,
  ) {
    this.request = view.requestAnimationFrame.bind(view);
    view.requestAnimationFrame = (callback) => {
      this.last += 1;
      this.waiting.set(this.last, callback);
      this.schedule();
      return this.last;
    };
    view.cancelAnimationFrame = (id) => void this.waiting.delete(id);
  }

  /** Draws nothing while nobody sees the view. */
  pause(paused: boolean): void {
    this.paused = paused;
    this.schedule();
  }

  /** The user does something in the workbench: that comes first. */
  yieldToInput(): void {
    if (this.slow > 0) this.rest(INPUT_MS);
  }

  private rest(ms: number): void {
    this.restUntil = Math.max(this.restUntil, this.clock.now() + ms);
  }

  private schedule(): void {
    if (this.scheduled || this.paused || this.looking || this.waiting.size === 0) return;
    this.scheduled = true;
    const wait = this.restUntil - this.clock.now();
    if (wait <= 1) {
      this.request((time) => this.run(time));
      return;
    }
    this.cancelTimer = this.clock.after(wait, () => {
      // The rest may have become longer.
      this.cancelTimer = null;
      this.scheduled = false;
      this.schedule();
    });
  }

  private run(time: number): void {
    this.scheduled = false;
    if (this.paused) return;
    const callbacks = [...this.waiting.values()];
    this.waiting.clear();
    const began = this.clock.now();
    this.rest((this.clock.focused() ? PICTURE_MS : UNFOCUSED_MS) - 4);
    if (began - this.lookedAt >= LOOK_MS || this.slow > 0) this.look(began);
    for (const callback of callbacks) {
      try {
        callback(time);
      } catch (error) {
        reportError(error);
      }
    }
    this.schedule();
  }

  /** How long the page waits for its second next frame: drawing in software shows only there. */
  private look(began: number): void {
    this.looking = true;
    this.lookedAt = began;
    this.request(() =>
      this.request(() => {
        const taken = this.clock.now() - began;
        this.looking = false;
        this.slow = taken > QUICK_MS ? this.slow + 1 : 0;
        if (this.slow > 0) this.rest(Math.min(LONGEST_REST_MS, taken * REST));
        if (this.slow === STAYS_SLOW) this.view.__viserTestpoints?.devSettings?.set?.({ fixedDpr: FEW_PIXELS });
        this.schedule();
      }),
    );
  }

  /** Ends what is planned; the window goes with its frame. */
  dispose(): void {
    this.paused = true;
    this.cancelTimer?.();
    this.waiting.clear();
  }
}

const BROWSER: FrameClock = {
  now: () => performance.now(),
  after: (ms, callback) => {
    const timer = setTimeout(callback, ms);
    return () => clearTimeout(timer);
  },
  focused: () => document.hasFocus(),
};
