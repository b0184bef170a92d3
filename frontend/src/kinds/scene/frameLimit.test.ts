import { beforeEach, expect, it } from 'vitest';
import { FrameLimit, type ViewWindow } from './frameLimit';

/** A window whose pictures take a time of their own, on a clock that the test moves. */
class World {
  now = 0;
  /** From a picture to the page's next one. */
  pictureMs = 16;
  drawn: number[] = [];
  pixels: number | null = null;
  focused = true;
  private readonly planned: { at: number; run: () => void }[] = [];
  readonly view: ViewWindow = {
    requestAnimationFrame: (callback) => this.plan(this.pictureMs, () => callback(this.now)),
    cancelAnimationFrame: () => undefined,
    __viserTestpoints: { devSettings: { set: ({ fixedDpr }) => void (this.pixels = fixedDpr) } },
  };
  readonly limit = new FrameLimit(this.view, {
    now: () => this.now,
    after: (ms, callback) => {
      this.plan(ms, callback);
      return () => undefined;
    },
    focused: () => this.focused,
  });

  private plan(ms: number, run: () => void): number {
    return this.planned.push({ at: this.now + ms, run });
  }

  /** A scene that moves all the time. */
  draw = () => {
    this.drawn.push(this.now);
    this.view.requestAnimationFrame(this.draw);
  };

  run(ms: number): void {
    const end = this.now + ms;
    for (;;) {
      this.planned.sort((a, b) => a.at - b.at);
      const next = this.planned[0];
      if (next === undefined || next.at > end) break;
      this.planned.shift();
      this.now = next.at;
      next.run();
    }
    this.now = end;
  }

  rate(ms: number): number {
    this.drawn = [];
    this.run(ms);
    return (this.drawn.length * 1000) / ms;
  }
}

let world: World;
beforeEach(() => {
  world = new World();
  world.draw();
});

it('draws a quick view up to 30 times a second, with all pixels', () => {
  const rate = world.rate(10_000);
  expect(rate).toBeGreaterThan(15);
  expect(rate).toBeLessThanOrEqual(31);
  expect(world.pixels).toBeNull();
});

it('leaves three quarters of the time to the page when pictures are slow, and draws fewer pixels', () => {
  world.pictureMs = 200;
  world.run(3000);
  // A picture is seen in two frames of the page, of 200 ms each.
  expect(world.rate(60_000)).toBeLessThanOrEqual(1000 / (400 + 3 * 400));
  expect(world.drawn.length).toBeGreaterThan(10);
  world.run(10_000);
  expect(world.pixels).toBe(0.5);
});

it('is quick again when pictures are', () => {
  world.pictureMs = 200;
  world.run(5000);
  world.pictureMs = 16;
  world.run(5000);
  expect(world.rate(10_000)).toBeGreaterThan(15);
});

it('draws nothing while nobody sees the view, and goes on with what was asked for', () => {
  world.run(1000);
  world.limit.pause(true);
  world.run(100);
  expect(world.rate(5000)).toBe(0);
  world.limit.pause(false);
  expect(world.rate(5000)).toBeGreaterThan(15);
});

it('waits while the user types, when pictures are slow', () => {
  world.pictureMs = 200;
  world.run(5000);
  world.drawn = [];
  for (let keys = 0; keys < 50; keys += 1) {
    world.limit.yieldToInput();
    world.run(100);
  }
  expect(world.drawn.length).toBeLessThanOrEqual(1);
  expect(world.rate(20_000)).toBeGreaterThan(0);
});

it('draws twice a second while another window has the focus', () => {
  world.focused = false;
  world.run(1000);
  expect(world.rate(10_000)).toBeLessThanOrEqual(2.1);
});

it('draws what is cancelled no more', () => {
  const other = new World();
  let drawn = 0;
  other.view.cancelAnimationFrame(other.view.requestAnimationFrame(() => void (drawn += 1)));
  other.run(1000);
  expect(drawn).toBe(0);
});
