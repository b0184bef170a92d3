import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  around,
  back,
  compressed,
  FIRST_VIEWS,
  forward,
  replaced,
  scrolled,
  shown,
  stretched,
  withRoom,
  zoomed,
} from './viewport';

const view = (max: number) => ({ x: { min: 0, max }, y: {} });

describe('the way through views', () => {
  it('goes back and forward, and forgets what was undone', () => {
    const two = shown(shown(FIRST_VIEWS, view(1)), view(2));
    expect(back(two).now).toEqual(view(1));
    expect(back(back(back(two))).now).toEqual(FIRST_VIEWS.now);
    expect(forward(back(two))).toEqual(two);
    expect(forward(shown(back(two), view(3))).now).toEqual(view(3));
  });

  it('counts a drag as one step', () => {
    const dragged = replaced(replaced(shown(FIRST_VIEWS, view(1)), view(2)), view(3));
    expect(dragged.now).toEqual(view(3));
    expect(back(dragged).now).toEqual(FIRST_VIEWS.now);
  });
});

describe('zoom', () => {
  it('leaves the place of the pointer where it is', () => {
    fc.assert(
      fc.property(
        fc.double({ min: -1e6, max: 1e6, noNaN: true }),
        fc.double({ min: 1, max: 1e6, noNaN: true }),
        fc.double({ min: 0, max: 1, noNaN: true }),
        fc.double({ min: 0.1, max: 10, noNaN: true }),
        (min, span, part, factor) => {
          const at = min + part * span;
          const now = zoomed({ min, max: min + span }, at, factor);
          expect(now.max - now.min).toBeCloseTo(span * factor, 3);
          expect((at - now.min) / (now.max - now.min)).toBeCloseTo(part, 6);
        },
      ),
    );
  });

  it('ends where nothing more could be told apart', () => {
    const range = { min: 5, max: 6 };
    expect(zoomed(range, 5.5, 0.5, 1)).toBe(range);
    expect(zoomed({ min: 1e15, max: 1e15 + 1 }, 1e15, 0.5)).toEqual({ min: 1e15, max: 1e15 + 1 });
  });

  it('stretches and compresses around the middle', () => {
    expect(stretched({ min: 0, max: 4 })).toEqual({ min: 1, max: 3 });
    expect(compressed({ min: 1, max: 3 })).toEqual({ min: 0, max: 4 });
    expect(scrolled({ min: 1, max: 3 }, 0.5)).toEqual({ min: 2, max: 4 });
  });
});

describe('ranges of values', () => {
  it('have room, and a size also for a constant', () => {
    expect(withRoom({ min: 0, max: 100 }, 0.1)).toEqual({ min: -10, max: 110 });
    expect(withRoom({ min: 8, max: 8 })).toEqual({ min: 4, max: 12 });
    expect(withRoom({ min: 0, max: 0 })).toEqual({ min: -1, max: 1 });
    expect(withRoom(null)).toEqual({ min: 0, max: 1 });
  });

  it('are around all there are', () => {
    expect(around([{ min: 1, max: 2 }, null, { min: -1, max: 0 }])).toEqual({ min: -1, max: 2 });
    expect(around([null])).toBeNull();
  });
});
