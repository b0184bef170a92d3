/** Tappets and their tracks (CAM-50 to CAM-59). */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { domainOf, type CamTable } from './camTable';
import { tappetRows } from './rows';
import { anyCam, DEFAULT_CAM } from './sampleCam';
import {
  ACTIONS,
  addTappet,
  addTrack,
  deleteTappet,
  mayBeTrackId,
  moveToTrack,
  nextAction,
  nextTrackId,
  setTappet,
  setTrackId,
  tappetOf,
} from './tappets';

const xs = (cam: CamTable, track = 0) => cam.tracks[track]!.tappets.map((tappet) => tappet.x);

describe('tappets', () => {
  it('are added in order of the master with ON and OFF', () => {
    const { cam, place } = addTappet(DEFAULT_CAM, 0, 180);
    expect(xs(cam)).toEqual([90, 180, 270]);
    expect(tappetOf(cam, place)).toEqual({ x: 180, positive: 'on', negative: 'off' });
    expect(xs(addTappet(DEFAULT_CAM, 0, 400).cam)).toEqual([90, 270, 360]);
  });

  it('move within the range and pass each other', () => {
    const moved = setTappet(DEFAULT_CAM, { track: 0, index: 0 }, { x: 300 });
    expect(xs(moved.cam)).toEqual([270, 300]);
    expect(moved.place.index).toBe(1);
    expect(xs(setTappet(DEFAULT_CAM, { track: 0, index: 0 }, { x: -7 }).cam)).toEqual([0, 270]);
  });

  it('have sixteen combinations that clicks reach (CAM-54)', () => {
    const seen = new Set<string>();
    let cam = DEFAULT_CAM;
    const place = { track: 0, index: 0 };
    for (let left = 0; left < 4; left++) {
      for (let right = 0; right < 4; right++) {
        const { positive, negative } = tappetOf(cam, place)!;
        seen.add(`${positive} ${negative}`);
        cam = setTappet(cam, place, { positive: nextAction(positive) }).cam;
      }
      cam = setTappet(cam, place, { negative: nextAction(tappetOf(cam, place)!.negative) }).cam;
    }
    expect(seen.size).toBe(16);
    expect(cam).toEqual(DEFAULT_CAM);
  });

  it('take their track with them when the last one goes (CAM-58)', () => {
    const one = deleteTappet(DEFAULT_CAM, { track: 0, index: 1 });
    expect(xs(one)).toEqual([90]);
    expect(deleteTappet(one, { track: 0, index: 0 }).tracks).toEqual([{ id: 2, tappets: [] }]);
  });

  it('move to another track by its id, also a new one (CAM-57)', () => {
    const moved = moveToTrack(DEFAULT_CAM, { track: 0, index: 0 }, 2);
    expect(moved.cam.tracks.map((track) => track.tappets.length)).toEqual([1, 1]);
    expect(tappetOf(moved.cam, moved.place)!.x).toBe(90);
    const last = moveToTrack(moved.cam, { track: 0, index: 0 }, 9);
    expect(last.cam.tracks.map((track) => track.id)).toEqual([2, 9]);
    expect(last.place).toEqual({ track: 1, index: 0 });
  });
});

describe('tracks', () => {
  it('are added with an unused id and a tappet at 0 (CAM-59)', () => {
    const { cam, place } = addTrack(setTrackId(DEFAULT_CAM, 1, 7));
    expect(cam.tracks[2]).toEqual({ id: 2, tappets: [{ x: 0, positive: 'on', negative: 'off' }] });
    expect(place).toEqual({ track: 2, index: 0 });
  });

  it('step over the ids of others (CAM-51)', () => {
    expect(nextTrackId(DEFAULT_CAM, 0, 1)).toBe(3);
    expect(nextTrackId(DEFAULT_CAM, 0, -1)).toBeNull();
    expect(nextTrackId(DEFAULT_CAM, 1, -1)).toBeNull();
    expect([2, 0, 1.5, 32_768, 1, 3].map((id) => mayBeTrackId(DEFAULT_CAM, 0, id))).toEqual([
      false,
      false,
      false,
      false,
      true,
      true,
    ]);
  });

  it('have a header row each, and a last row that adds one (CAM-55)', () => {
    expect(tappetRows(DEFAULT_CAM).map((row) => row.kind)).toEqual(['track', 'tappet', 'tappet', 'track', 'add']);
  });
});

describe('any tappets', () => {
  it('stay in order, in range and in number', () => {
    fc.assert(
      fc.property(
        anyCam,
        fc.nat(99),
        fc.nat(99),
        fc.double({ min: -9e3, max: 9e3, noNaN: true }),
        (cam, one, other, x) => {
          const places = cam.tracks.flatMap(({ tappets }, track) => tappets.map((_, index) => ({ track, index })));
          fc.pre(places.length > 0);
          const place = places[one % places.length]!;
          const action = ACTIONS[other % 4]!;
          const results = [
            setTappet(cam, place, { x, positive: action }),
            moveToTrack(cam, place, 1 + (other % 5)),
            addTrack(cam),
            addTappet(cam, place.track, x),
          ];
          const count = (of: CamTable) => tappetRows(of).filter((row) => row.kind === 'tappet').length;
          expect(results.map(({ cam: after }) => count(after))).toEqual(
            [0, 0, 1, 1].map((more) => places.length + more),
          );
          for (const { cam: after, place: there } of results) {
            expect(tappetOf(after, there)).toBeDefined();
            const [first, last] = domainOf(after);
            expect(new Set(after.tracks.map((track) => track.id)).size).toBe(after.tracks.length);
            after.tracks.forEach(({ tappets }) =>
              tappets.forEach((tappet, at) => {
                expect(tappet.x).toBeGreaterThanOrEqual(at > 0 ? tappets[at - 1]!.x : first);
                expect(tappet.x).toBeLessThanOrEqual(last);
              }),
            );
          }
        },
      ),
    );
  });
});
