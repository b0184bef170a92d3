/**
 * Paints the values of a table's rows into canvases, each of which covers some rows.
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

/** The rows that a canvas covers; sizes in CSS pixels. */
export interface CanvasRows {
  readonly first: number;
  readonly count: number;
  readonly rowHeight: number;
  /** From the left edge of the table. */
  readonly left: number;
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

/** A canvas and what it covers. */
interface Surface {
  readonly context: CanvasRenderingContext2D;
  /** The font last set: setting one costs more than a text in it. */
  font: string;
  readonly rows: CanvasRows;
  /** Device pixels of a CSS pixel. */
  readonly scale: number;
}

const PADDING_PX = 8;
/** The line below each row. */
const LINE_PX = 1;
const PILL = { around: 4, height: 18, radius: 3 };

export class ValuePainter {
  private readonly rows = new Map<number, Painted>();
  /** Rows to be painted at the end of this turn: all that change in a frame at once, each once. */
  private readonly outdated = new Set<number>();
  private readonly surfaces = new Map<HTMLCanvasElement, Surface>();
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
    const context = canvas.getContext('2d');
    if (context === null) return;
    const scale = canvas.ownerDocument.defaultView?.devicePixelRatio ?? 1;
    const top = rows.first * rows.rowHeight;
    // Only one that begins and ends between device pixels is shown as it was painted: another is stretched and blurred.
    const whole = (px: number) => Math.round(px * scale);
    const size = { width: whole(rows.width), height: whole(top + rows.count * rows.rowHeight) - whole(top) };
    const px = (devicePixels: number) => `${String(devicePixels / scale)}px`;
    Object.assign(canvas.style, {
      left: px(whole(rows.left)),
      top: px(whole(top)),
      width: px(size.width),
      height: px(size.height),
    });
    // A canvas of a new size is empty; one that keeps its size is not made anew.
    if (canvas.width !== size.width) canvas.width = size.width;
    if (canvas.height !== size.height) canvas.height = size.height;
    // Its state goes with its old size.
    const surface = { context, font: '', rows, scale };
    this.surfaces.set(canvas, surface);
    this.paintAll(surface);
  }

  /** Paints into `canvas` no more, which gives its memory back. */
  uncover(canvas: HTMLCanvasElement): void {
    this.surfaces.delete(canvas);
    canvas.width = canvas.height = 0;
  }

  /** Colours or fonts have changed. */
  restyle(): void {
    this.looks = null;
    for (const surface of this.surfaces.values()) this.paintAll(surface);
  }

  private paintAll({ context, rows, scale }: Surface): void {
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, rows.width, rows.count * rows.rowHeight);
    for (let row = rows.first; row < rows.first + rows.count; row += 1) if (this.rows.has(row)) this.invalidate(row);
  }

  private invalidate(row: number): void {
    if (this.outdated.size === 0) queueMicrotask(() => this.paint());
    this.outdated.add(row);
  }

  private paint(): void {
    const outdated = [...this.outdated];
    this.outdated.clear();
    const looks = (this.looks ??= this.readLooks());
    if (looks === null) return;
    for (const surface of this.surfaces.values()) {
      const { first, count, width } = surface.rows;
      const rows = outdated.filter((row) => row >= first && row < first + count);
      if (rows.length > 0 && width > 0) this.paintRows(surface, rows, looks);
    }
  }

  private paintRows(surface: Surface, rows: readonly number[], looks: Looks): void {
    const { context, rows: covered, scale } = surface;
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
      if (tone !== 'lost' && shown.some(({ fresh }) => fresh)) {
        context.fillStyle = looks.tones.fresh.color;
        shown.forEach(({ fresh, inset, middle }, at) => {
          if (!fresh) return;
          const width = texts[at]!.length * looks.digit + 2 * PILL.around;
          const left = PADDING_PX + inset - PILL.around;
          context.beginPath();
          context.roundRect(left, middle - PILL.height / 2, width, PILL.height, PILL.radius);
          context.fill();
        });
      }
      const { color, font } = looks.tones[tone];
      if (surface.font !== font) context.font = surface.font = font;
      context.fillStyle = color;
      shown.forEach(({ inset, middle }, at) =>
        context.fillText(texts[at]!, PADDING_PX + inset, Math.round((middle + looks.baseline) * scale) / scale),
      );
    }
  }

  /** Colours and fonts as the style sheet gives them to a canvas; null while none is on a page. */
  private readLooks(): Looks | null {
    const [canvas, surface] = [...this.surfaces].find(([each]) => each.isConnected) ?? [];
    const view = canvas?.ownerDocument.defaultView;
    if (canvas === undefined || surface === undefined || view == null) return null;
    const { context } = surface;
    const tones = {} as Record<Tone | 'fresh', Look>;
    const style = view.getComputedStyle(canvas);
    for (const tone of LOOKS) {
      canvas.dataset.tone = tone;
      const font = `${style.fontStyle} ${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
      tones[tone] = { color: style.color, font };
    }
    delete canvas.dataset.tone;
    context.font = surface.font = tones.plain.font;
    const { width, fontBoundingBoxAscent, fontBoundingBoxDescent } = context.measureText('0');
    return { tones, digit: width || 8, baseline: (fontBoundingBoxAscent - fontBoundingBoxDescent) / 2 };
  }
}

function shortened(text: string, most: number): string {
  return text.length <= most ? text : `${text.slice(0, most - 1)}\u2026`;
}
