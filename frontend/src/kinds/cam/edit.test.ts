import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { t } from '@/i18n';
import { heldReason, pointFault } from './cells';
import type { CamTable } from './camTable';
import type { CamEdit } from './edit';
import { insertAt, nudged, removable, removed, stepped } from './keyActs';
import { setLaw } from './points';
import { ordered, propertiesOf } from './properties';
import type { Selected } from './rows';
import { anyCam, DEFAULT_CAM, poly5 } from './sampleCam';
import { onRanges } from './tappetBit';
import { moveSegment } from './useGraphDrag';

/** A cam under edit without a view. */
function editOf(cam: CamTable, selected: Selected | null = null): CamEdit & { now: () => CamTable } {
  const edit: CamEdit & { now: () => CamTable } = {
    cam,
    drawing: null,
    running: null,
    locked: false,
    selected,
    select: (next) => {
      edit.selected = next;
    },
    change: (next, select) => {
      edit.cam = next;
      if (select !== undefined) edit.selected = select;
    },
    preview: () => undefined,
    valuesAt: (x) => Promise.resolve(poly5(cam.points[0]!, cam.points[1]!, x)),
    now: () => edit.cam,
  };
  return edit;
}

describe('the keyboard', () => {
  it('goes through points and segments and stays at both ends', () => {
    const edit = editOf(DEFAULT_CAM);
    const seen: Selected[] = [];
    for (let step = 0; step < 9; step++) {
      stepped(edit, 1);
      seen.push(edit.selected!);
    }
    expect(seen.slice(0, 4)).toEqual([
      { kind: 'point', index: 0 },
      { kind: 'segment', index: 0 },
      { kind: 'point', index: 1 },
      { kind: 'segment', index: 1 },
    ]);
    expect(seen.at(-1)).toEqual({ kind: 'point', index: 3 });
  });

  it('moves a point by steps', () => {
    const edit = editOf(DEFAULT_CAM, { kind: 'point', index: 1 });
    nudged(edit, 'y', { x: 0, value: 1 }, { x: 5, value: 2 }, 10);
    nudged(edit, 'v', { x: -1, value: 0 }, { x: 5, value: 2 }, 1);
    expect(edit.now().points[1]).toMatchObject({ x: 115, y: 140, v: 1 });
    nudged(edit, 'j', { x: 0, value: 1 }, { x: 5, value: 2 }, 1);
    expect(edit.now().points[1]).toMatchObject({ x: 115, y: 140, v: 1, j: 0 });
  });

  it('deletes points but not start and end', () => {
    const edit = editOf(DEFAULT_CAM, { kind: 'point', index: 0 });
    expect(removable(edit)).toBe(false);
    removed(edit);
    expect(edit.now().points).toHaveLength(4);
    edit.selected = { kind: 'point', index: 2 };
    removed(edit);
    expect(edit.now().points.map((point) => point.x)).toEqual([0, 120, 360]);
    expect(edit.selected).toEqual({ kind: 'segment', index: 1 });
  });

  it('inserts in the middle of the segment, on the curve (cam EX-03)', async () => {
    const edit = editOf(DEFAULT_CAM, { kind: 'segment', index: 0 });
    await insertAt(edit, null, 'y', null);
    expect(edit.now().points[1]).toMatchObject({ x: 60, y: 41.25, v: 1.4375, a: 0.0125 });
    expect(edit.selected).toEqual({ kind: 'point', index: 1 });
  });
});

describe('a segment that is dragged', () => {
  it('takes both of its points along', () => {
    const moved = moveSegment(DEFAULT_CAM, 1, 'y', 25);
    expect(moved.points.map((point) => point.y)).toEqual([0, 145, 265, 360]);
    expect(moveSegment(DEFAULT_CAM, 1, 'a', 0.5).points.map((point) => point.a)).toEqual([0, 0.5, 0.5, 0]);
  });
});

describe('a typed value', () => {
  it('must be a number between the neighbours', () => {
    expect(pointFault(DEFAULT_CAM, 1, 'x', 'abc')).toBe('cam.fault.number');
    expect(pointFault(DEFAULT_CAM, 1, 'x', '240')).toBe('cam.fault.between');
    expect(pointFault(DEFAULT_CAM, 1, 'x', '239')).toBeNull();
    expect(pointFault(DEFAULT_CAM, 0, 'x', '1')).toBe('cam.fault.end');
    expect(pointFault(DEFAULT_CAM, 1, 'y', '1e13')).toBe('cam.fault.far');
    expect(pointFault(DEFAULT_CAM, 1, 'y', '-1e11')).toBeNull();
  });

  it('cannot be typed where a segment gives it', () => {
    const line = setLaw(DEFAULT_CAM, 1, 'line');
    expect(heldReason(line, 1, 'v')).toBe('cam.held.law');
    expect(heldReason(line, 0, 'v')).toBeNull();
    expect(heldReason(line, 1, 'j')).toBe('cam.held.jerk');
    expect(heldReason(setLaw(line, 2, 'poly7'), 3, 'j')).toBeNull();
  });
});

describe('properties', () => {
  it('list all of an element, and what is computed is not to be changed (CAM-60, CAM-64)', () => {
    const point = propertiesOf(editOf(DEFAULT_CAM), { kind: 'point', index: 1 }, t);
    expect(point.map(({ id, set }) => [id, set !== undefined])).toEqual([
      ['x', true],
      ['y', true],
      ['v', true],
      ['a', true],
      ['j', false],
    ]);
    const segment = propertiesOf(editOf(DEFAULT_CAM), { kind: 'segment', index: 0 }, t);
    expect(segment.filter(({ set }) => set).map(({ id }) => id)).toEqual(['law']);
  });

  it('change what they are about (CAM-63)', () => {
    const edit = editOf(DEFAULT_CAM);
    const tappet: Selected = { kind: 'tappet', track: 0, index: 1 };
    const of = (id: string) => propertiesOf(edit, tappet, t).find((one) => one.id === id)!;
    expect(of('x').check!('361')).not.toBeNull();
    of('positive').set!('off');
    expect(edit.now().tracks[0]!.tappets[1]!.positive).toBe('off');
    of('track').set!('2');
    expect(edit.now().tracks.map((track) => track.tappets.length)).toEqual([1, 1]);
    expect(edit.selected).toEqual({ kind: 'tappet', track: 1, index: 0 });
  });

  it('cannot be changed while the cam is locked', () => {
    const locked = { ...editOf(DEFAULT_CAM), locked: true };
    const all = (['point', 'segment'] as const).flatMap((kind) => propertiesOf(locked, { kind, index: 0 }, t));
    expect(all.some(({ set }) => set)).toBe(false);
  });

  it('are sorted by type or name, both ways (CAM-61)', () => {
    const all = propertiesOf(editOf(DEFAULT_CAM), { kind: 'segment', index: 0 }, t);
    expect(ordered(all, 'type', true)[0]!.group).toBe('computed');
    const titles = ordered(all, 'name', false).map(({ title }) => title);
    expect(titles).toEqual([...titles].sort((one, other) => one.localeCompare(other)));
  });
});

describe('the bit of a track', () => {
  it('is that of cam EX-06', () => {
    const tappets = [
      { x: 90, positive: 'on', negative: 'off' },
      { x: 270, positive: 'off', negative: 'on' },
    ] as const;
    expect(onRanges(tappets, { min: 0, max: 360 })).toEqual([[90, 270]]);
    expect(onRanges([{ x: 180, positive: 'invert', negative: 'invert' }], { min: 0, max: 360 })).toEqual([[180, 360]]);
  });

  it('is the same as passing one tappet after the other', () => {
    fc.assert(
      fc.property(anyCam, fc.double({ min: 0, max: 1, noNaN: true }), (cam, part) => {
        const [min, max] = [cam.points[0]!.x, cam.points.at(-1)!.x];
        const at = min + part * (max - min);
        for (const { tappets } of cam.tracks) {
          let on = false;
          for (const { x, positive } of tappets)
            if (x <= at && positive !== 'none') on = positive === 'on' || (positive === 'invert' && !on);
          const inside = onRanges(tappets, { min, max }).some(([from, to]) => from <= at && (at < to || to === max));
          if (at < max) expect(inside).toBe(on);
        }
      }),
    );
  });
});
