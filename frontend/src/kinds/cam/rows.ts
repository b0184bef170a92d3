/** The rows of both tables of a cam (CAM-40, CAM-55), and what is selected in all views. Pure functions. */
import type { CamTable } from './camTable';
import type { TappetPlace } from './tappets';

export type CamRow = { kind: 'point'; index: number } | { kind: 'segment'; index: number };
export type Selected = CamRow | ({ kind: 'tappet' } & TappetPlace);

/** Start point, then segments and points in turn: one row fewer than twice the points. */
export function camRows(cam: CamTable): CamRow[] {
  return cam.points.flatMap((_, index): CamRow[] =>
    index < cam.segments.length
      ? [
          { kind: 'point', index },
          { kind: 'segment', index },
        ]
      : [{ kind: 'point', index }],
  );
}

export function rowOf({ kind, index }: CamRow): number {
  return 2 * index + (kind === 'segment' ? 1 : 0);
}

export type TappetRow =
  | { kind: 'track'; track: number }
  | ({ kind: 'tappet' } & TappetPlace)
  /** The last one, whose plus adds a track. */
  | { kind: 'add' };

export function tappetRows(cam: CamTable): TappetRow[] {
  const rows = cam.tracks.flatMap((one, track): TappetRow[] => [
    { kind: 'track', track },
    ...one.tappets.map((_, index) => ({ kind: 'tappet' as const, track, index })),
  ]);
  return [...rows, { kind: 'add' }];
}

/** What is still there after a change of the cam; null where it is gone. */
export function stillThere(cam: CamTable, selected: Selected | null): Selected | null {
  if (selected === null) return null;
  if (selected.kind === 'tappet') return cam.tracks[selected.track]?.tappets[selected.index] ? selected : null;
  return selected.index < (selected.kind === 'point' ? cam.points : cam.segments).length ? selected : null;
}
