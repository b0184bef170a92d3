/**
 * Paints the values of a table's rows into one canvas.
 *
 * A text that changes in the page costs style, layout and paint of its box; 1,000 at 10 Hz take a whole processor that
 * way. Painting the same texts leaves the main thread four fifths of its time, measured in `docs/benchmarks.md`.
 * Who reads the page by other means finds each value as the label of its cell.
 */
import type { FreshMark } from './freshMarks';

/** Looks of a value; each is a `data-tone` of the canvas in the style sheet. */
export type Tone = 'plain' | 'true' | 'false' | 'forced' | 'lost';

const VALUE_TONES: readonly Tone[] = ['plain', 'true', 'false', 'forced', 'lost'];
/** Those, and the ground of a value that has changed lately. */
const LOOKS: readonly (Tone | 'fresh')[] = [...VALUE_TONES, 'fresh'];

/** Where a value is shown: a cell of the page, or a row of a canvas. */
export interface ValuePlace extends FreshMark {
  show: (text: string, tone: Tone) => void;
  remove: () => void;
}

/** The rows that a canvas covers, in CSS pixels. */
export interface CanvasRows {
  readonly first: number;
  readonly count: number;
  readonly rowHeight: number;
  readonly width: number;
}

interface Look {
  readonly color: string;
  readonly font: string;
}

interface Looks {
  readonly tones: Readonly<Record<Tone | 'fresh', Look>>;
  /** Width of a digit in CSS pixels; the font has one width for all. */
  readonly digit: number;
  /** Pixels from the middle of a line to its baseline, as the page lays out the texts beside. */
  readonly baseline: number;
}

interface Painted {
  text: string;
  tone: Tone;
  fresh: boolean;
  /** Pixels that marks in front of the value take. */
  readonly inset: number;
}

const PADDING_PX = 8;
/** The line below each row. */
const LINE_PX = 1;
const PILL = { around: 4, height: 18, radius: 3 };
/** Most device pixels a side that all browsers paint. */
const MOST_PX = 32_000;

export class ValuePainter {
  private readonly rows = new Map<number, Painted>();
  /** Rows to be painted at the end of this turn: all that change in a frame at once, each once. */
  private readonly outdated = new Set<number>();
  private canvas: HTMLCanvasElement | null = null;
  private context: CanvasRenderingContext2D | null = null;
  private covered: CanvasRows = { first: 0, count: 0, rowHeight: 0, width: 0 };
  private scale = 1;
  private looks: Looks | null = null;

  /** A place for the value of a row; the marks of the cell take `inset` pixels in front of it. */
  row(row: number, inset: number): ValuePlace {
    const painted: Painted = { text: '', tone: 'plain', fresh: false, inset };
    this.rows.set(row, painted);
    return {
      show: (text, tone) => {
        if (painted.text === text && painted.tone === tone) return;
        painted.text = text;
        painted.tone = tone;
        this.invalidate(row);
      },
      setFresh: (fresh) => {
        painted.fresh = fresh;
        this.invalidate(row);
      },
      remove: () => {
        if (this.rows.get(row) !== painted) return;
        this.rows.delete(row);
        this.invalidate(row);
      },
    };
  }

  /** Paints into `canvas`, which covers these rows from now on. */
  cover(canvas: HTMLCanvasElement, rows: CanvasRows): void {
    if (this.canvas !== canvas) this.looks = null;
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.covered = rows;
    const height = rows.count * rows.rowHeight;
    const ratio = canvas.ownerDocument.defaultView?.devicePixelRatio ?? 1;
    this.scale = Math.min(ratio, MOST_PX / Math.max(1, height, rows.width));
    // A canvas of a new size is empty; one that keeps its size is not made anew.
    const size = { width: Math.ceil(rows.width * this.scale), height: Math.ceil(height * this.scale) };
    if (canvas.width !== size.width) canvas.width = size.width;
    if (canvas.height !== size.height) canvas.height = size.height;
    this.paintAll();
  }

  /** Colours or fonts have changed. */
  restyle(): void {
    this.looks = null;
    this.paintAll();
  }

  private paintAll(): void {
    const { context, covered, scale } = this;
    context?.setTransform(scale, 0, 0, scale, 0, 0);
    context?.clearRect(0, 0, covered.width, covered.count * covered.rowHeight);
    for (const row of this.rows.keys()) this.invalidate(row);
  }

  private invalidate(row: number): void {
    if (this.outdated.size === 0) queueMicrotask(() => this.paint());
    this.outdated.add(row);
  }

  private paint(): void {
    const { context, covered, scale } = this;
    const rows = [...this.outdated].filter((row) => row >= covered.first && row < covered.first + covered.count);
    this.outdated.clear();
    if (rows.length === 0 || context === null || covered.width <= 0) return;
    const looks = (this.looks ??= this.readLooks());
    if (looks === null) return;
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.textBaseline = 'alphabetic';
    for (const row of rows)
      context.clearRect(0, (row - covered.first) * covered.rowHeight, covered.width, covered.rowHeight);
    // By look: another font or colour for each value would cost more than its text.
    for (const tone of VALUE_TONES) {
      const shown = rows.flatMap((row): (Painted & { middle: number })[] => {
        const painted = this.rows.get(row);
        if (painted?.tone !== tone || painted.text === '') return [];
        return [{ ...painted, middle: (row - covered.first) * covered.rowHeight + (covered.rowHeight - LINE_PX) / 2 }];
      });
      if (shown.length === 0) continue;
      const room = ({ inset }: Painted) => Math.floor((covered.width - inset - 2 * PADDING_PX) / looks.digit);
      const texts = shown.map((each) => shortened(each.text, Math.max(1, room(each))));
      context.beginPath();
      shown.forEach(({ fresh, inset, middle }, at) => {
        if (!fresh || tone === 'lost') return;
        const width = texts[at]!.length * looks.digit + 2 * PILL.around;
        const left = PADDING_PX + inset - PILL.around;
        context.roundRect(left, middle - PILL.height / 2, width, PILL.height, PILL.radius);
      });
      context.fillStyle = looks.tones.fresh.color;
      context.fill();
      context.font = looks.tones[tone].font;
      context.fillStyle = looks.tones[tone].color;
      shown.forEach(({ inset, middle }, at) =>
        context.fillText(texts[at]!, PADDING_PX + inset, Math.round(middle + looks.baseline)),
      );
    }
  }

  /** Colours and fonts as the style sheet gives them to the canvas; null while it is on no page. */
  private readLooks(): Looks | null {
    const { canvas, context } = this;
    const view = canvas?.ownerDocument.defaultView;
    if (canvas?.isConnected !== true || context === null || view == null) return null;
    const tones = {} as Record<Tone | 'fresh', Look>;
    const style = view.getComputedStyle(canvas);
    for (const tone of LOOKS) {
      canvas.dataset.tone = tone;
      const font = `${style.fontStyle} ${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
      tones[tone] = { color: style.color, font };
    }
    delete canvas.dataset.tone;
    context.font = tones.plain.font;
    const { width, fontBoundingBoxAscent, fontBoundingBoxDescent } = context.measureText('0');
    return { tones, digit: width || 8, baseline: (fontBoundingBoxAscent - fontBoundingBoxDescent) / 2 };
  }
}

function shortened(text: string, most: number): string {
  return text.length <= most ? text : `${text.slice(0, most - 1)}\u2026`;
}
