// @vitest-environment happy-dom
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { ValuePainter } from './valuePainter';

/** What has been painted: texts by row, in the order of painting. */
interface Stroke {
  kind: 'text' | 'clear' | 'pill';
  row: number;
  text?: string;
  color?: string;
}

const ROW = 26;
let strokes: Stroke[] = [];
let canvas: HTMLCanvasElement;

const COLORS: Readonly<Record<string, string>> = { true: 'blue', false: 'gray', forced: 'red', lost: 'silver' };

beforeEach(() => {
  strokes = [];
  canvas = document.body.appendChild(document.createElement('canvas'));
  const style = document.head.appendChild(document.createElement('style'));
  style.textContent = Object.entries(COLORS)
    .map(([tone, color]) => `canvas[data-tone='${tone}'] { color: ${color}; }`)
    .join('\n');
  const row = (y: number) => Math.floor(y / ROW);
  const context = {
    fillStyle: '',
    font: '',
    textBaseline: '',
    setTransform: () => undefined,
    beginPath: () => undefined,
    fill: () => undefined,
    measureText: () => ({ width: 8, fontBoundingBoxAscent: 13, fontBoundingBoxDescent: 4 }),
    clearRect: (_: number, y: number) => strokes.push({ kind: 'clear', row: row(y) }),
    roundRect: (_: number, y: number) => strokes.push({ kind: 'pill', row: row(y) }),
    fillText(text: string, _: number, y: number) {
      strokes.push({ kind: 'text', row: row(y), text, color: this.fillStyle });
    },
  };
  canvas.getContext = (() => context) as never;
});
afterEach(() => {
  document.head.replaceChildren();
  document.body.replaceChildren();
});

/** After this turn, in which all changes are collected. */
const painted = async () => {
  await Promise.resolve();
  const done = strokes;
  strokes = [];
  return done;
};
const texts = (done: readonly Stroke[]) => done.filter(({ kind }) => kind === 'text').map((s) => [s.row, s.text]);

function cover(painter: ValuePainter, first = 0, count = 10, width = 150): void {
  painter.cover(canvas, { first, count, rowHeight: ROW, left: 0, width });
}

describe('values painted into a canvas', () => {
  it('paint what has changed, each row once, and nothing for the same text', async () => {
    const painter = new ValuePainter();
    cover(painter);
    strokes = [];
    const [a, b] = [painter.row(0, 0), painter.row(3, 0)];
    a.show('1', 'plain');
    b.show('7', 'plain');
    a.show('2', 'plain');
    a.setFresh(true);
    const done = await painted();
    expect(texts(done)).toEqual([[0, '2'], [3, '7']]); // prettier-ignore
    expect(done.filter(({ kind }) => kind === 'pill')).toEqual([{ kind: 'pill', row: 0 }]);
    a.show('2', 'plain');
    expect(await painted()).toEqual([]);
    b.show('8', 'plain');
    expect(texts(await painted())).toEqual([[3, '8']]);
  });

  it('have the colour of their look', async () => {
    const painter = new ValuePainter();
    cover(painter);
    const tones = ['true', 'false', 'forced', 'lost'] as const;
    tones.forEach((tone, row) => painter.row(row, 0).show(tone, tone));
    const done = (await painted()).filter(({ kind }) => kind === 'text');
    expect(done.map(({ text, color }) => [text, color])).toEqual(tones.map((tone) => [tone, COLORS[tone]]));
    expect(canvas.dataset.tone).toBeUndefined();
  });

  it('are painted for covered rows only, and again when the canvas covers others', async () => {
    const painter = new ValuePainter();
    cover(painter, 0, 4);
    strokes = [];
    const far = painter.row(6, 0);
    far.show('far', 'plain');
    expect(await painted()).toEqual([]);
    cover(painter, 4, 4);
    const done = await painted();
    // What was painted for other rows goes first.
    expect(done[0]?.kind).toBe('clear');
    expect(texts(done)).toEqual([[2, 'far']]);
  });

  it('leave their row empty when they go, unless another value has it', async () => {
    const painter = new ValuePainter();
    cover(painter);
    const old = painter.row(1, 0);
    old.show('old', 'plain');
    await painted();
    const next = painter.row(1, 0);
    next.show('next', 'plain');
    old.remove();
    expect(texts(await painted())).toEqual([[1, 'next']]);
    next.remove();
    expect(await painted()).toEqual([{ kind: 'clear', row: 1 }]);
  });

  it('are painted each into the canvas that covers its row, and no other canvas is painted', async () => {
    const painter = new ValuePainter();
    const lower = document.body.appendChild(document.createElement('canvas'));
    const paintedBelow: unknown[] = [];
    const below = { ...canvas.getContext('2d'), fillText: (text: string) => paintedBelow.push(text) };
    lower.getContext = (() => below) as never;
    cover(painter, 0, 4);
    const rows = { first: 4, count: 4, rowHeight: ROW, left: 0, width: 150 };
    painter.cover(lower, rows);
    strokes = [];
    const [above, under] = [painter.row(1, 0), painter.row(5, 0)];
    under.show('5', 'plain');
    expect(await painted()).toEqual([{ kind: 'clear', row: 1 }]);
    above.show('1', 'plain');
    expect(texts(await painted())).toEqual([[1, '1']]);
    expect(paintedBelow).toEqual(['5']);
    // Rows that scroll into view have a canvas of their own; those of the others are painted already.
    painter.uncover(canvas);
    above.show('2', 'plain');
    expect(texts(await painted())).toEqual([]);
    expect(paintedBelow).toEqual(['5']);
  });

  it('stand on canvases of whole device pixels at every zoom, without gaps', () => {
    for (const ratio of [0.8, 0.9, 1, 1.1, 1.25, 1.5, 1.75, 2]) {
      vi.stubGlobal('devicePixelRatio', ratio);
      const painter = new ValuePainter();
      let end = 0;
      for (const first of [0, 16, 32, 48]) {
        painter.cover(canvas, { first, count: 16, rowHeight: ROW, left: 333, width: 151 });
        const { left, top, width, height } = canvas.style;
        const device = [left, top, width, height].map((px) => Number.parseFloat(px) * ratio);
        device.forEach((pixels) => expect(pixels).toBeCloseTo(Math.round(pixels), 4));
        expect([canvas.width, canvas.height]).toEqual(device.slice(2).map(Math.round));
        expect(device[1]).toBeCloseTo(end, 4);
        expect(Math.abs(device[1]! - first * ROW * ratio)).toBeLessThan(0.501);
        end = device[1]! + device[3]!;
      }
      vi.unstubAllGlobals();
    }
  });

  it('are shortened to their column', async () => {
    const painter = new ValuePainter();
    cover(painter, 0, 4, 8 * 10 + 16);
    painter.row(0, 0).show('0123456789', 'plain');
    painter.row(1, 16).show('0123456789', 'plain');
    expect(texts(await painted())).toEqual([[0, '0123456789'], [1, '0123456…']]); // prettier-ignore
  });
});
