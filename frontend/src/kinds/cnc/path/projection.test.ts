import { describe, expect, it } from 'vitest';
import { facingPlane, onPlane, pixelSize, rayThrough, seenAt, type Eye, type Frame, type Vector } from './projection';

/** A camera above the plane X/Y, Y of it up on the screen, 100 x 50 pixels, 90 degrees. */
function above(height: number): Eye {
  // Columns: right, up and back of the camera, and its place.
  const world = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, height, 1];
  const inverse = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -height, 1];
  const projection = [0.5, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -0.1, 0];
  return { world, inverse, projection, width: 100, height: 50 };
}

const FRAME: Frame = { centre: [500, 200, 0], scale: 0.1 };

describe('a place on the screen', () => {
  it('is where perspective puts it', () => {
    const eye = above(10);
    expect(seenAt(eye, FRAME, [500, 200, 0])).toEqual({ x: 50, y: 25 });
    // 50 u are 5 of the picture, at 10: half the height, a quarter of the width.
    expect(seenAt(eye, FRAME, [550, 250, 0])).toEqual({ x: 62.5, y: 12.5 });
    // Nearer places are further from the middle.
    expect(seenAt(eye, FRAME, [550, 250, 50])).toEqual({ x: 75, y: 0 });
    expect(seenAt(eye, FRAME, [500, 200, 101])).toBeNull();
    expect(pixelSize(eye, FRAME, [510, 300, 0])).toBeCloseTo(4);
  });

  it('lies on the ray through its point', () => {
    const eye = above(10);
    for (const place of [
      [530, 170, 0],
      [411, 302, 20],
      [500, 200, -7],
    ] as Vector[]) {
      const ray = rayThrough(eye, FRAME, seenAt(eye, FRAME, place)!);
      const met = onPlane(ray, place, [0, 0, 1])!;
      met.forEach((value, at) => expect(value).toBeCloseTo(place[at]!, 9));
    }
  });
});

it('one drags in the plane that one sees', () => {
  const looking = (ahead: Vector) => facingPlane({ origin: [0, 0, 0], ahead });
  expect(looking([0.1, 0.2, -0.97])).toEqual([0, 0, 1]);
  expect(looking([0.9, 0.43, -0.05])).toEqual([1, 0, 0]);
  expect(looking([0.3, -0.95, 0.02])).toEqual([0, 1, 0]);
});

it('a plane behind, or along the ray, is not met', () => {
  expect(onPlane({ origin: [0, 0, 5], ahead: [0, 0, 1] }, [0, 0, 0], [0, 0, 1])).toBeNull();
  expect(onPlane({ origin: [0, 0, 5], ahead: [1, 0, 0] }, [0, 0, 0], [0, 0, 1])).toBeNull();
});
