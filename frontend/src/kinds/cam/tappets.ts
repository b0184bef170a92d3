/** Acts on tappets and their tracks (CAM-50 to CAM-59): a cam to another. Pure functions. */
import {
  domainOf,
  replaced,
  within,
  type CamTable,
  type CamTappet,
  type CamTrack,
  type TappetAction,
} from './camTable';

export const ACTIONS: readonly TappetAction[] = ['none', 'on', 'off', 'invert'];
/** Names the bit: iGroupID is an INT. */
const LAST_TRACK = 32_767;
const NEW_TAPPET = { positive: 'on', negative: 'off' } as const;

/** A tappet by its places in the lists. */
export interface TappetPlace {
  track: number;
  index: number;
}

export interface Placed {
  cam: CamTable;
  place: TappetPlace;
}

/** Of the action that a click changes: the next one (CAM-54). */
export function nextAction(action: TappetAction): TappetAction {
  return ACTIONS[(ACTIONS.indexOf(action) + 1) % ACTIONS.length]!;
}

export function tappetOf(cam: CamTable, { track, index }: TappetPlace): CamTappet | undefined {
  return cam.tracks[track]?.tappets[index];
}

/** A track with one tappet more, in order of the master; behind those at the same X. */
function withTappet(track: CamTrack, tappet: CamTappet): { track: CamTrack; index: number } {
  const behind = track.tappets.findIndex((one) => one.x > tappet.x);
  const index = behind < 0 ? track.tappets.length : behind;
  return { track: { ...track, tappets: track.tappets.toSpliced(index, 0, tappet) }, index };
}

function without(track: CamTrack, index: number): CamTrack {
  return { ...track, tappets: track.tappets.filter((_, at) => at !== index) };
}

/** A new tappet with the default actions on a track (CAM-52), within the range of the master. */
export function addTappet(cam: CamTable, track: number, x: number): Placed {
  const added = withTappet(cam.tracks[track]!, { x: within(x, domainOf(cam)), ...NEW_TAPPET });
  return { cam: { ...cam, tracks: replaced(cam.tracks, track, added.track) }, place: { track, index: added.index } };
}

/** Changes X, limited to the range of the master, or the actions of a tappet. */
export function setTappet(cam: CamTable, place: TappetPlace, changes: Partial<CamTappet>): Placed {
  const before = tappetOf(cam, place)!;
  const tappet = { ...before, ...changes, x: within(changes.x ?? before.x, domainOf(cam)) };
  const track = cam.tracks[place.track]!;
  if (tappet.x === before.x)
    return {
      cam: {
        ...cam,
        tracks: replaced(cam.tracks, place.track, { ...track, tappets: replaced(track.tappets, place.index, tappet) }),
      },
      place,
    };
  const moved = withTappet(without(track, place.index), tappet);
  return {
    cam: { ...cam, tracks: replaced(cam.tracks, place.track, moved.track) },
    place: { ...place, index: moved.index },
  };
}

/** Deletes a tappet; with the last one its track disappears (CAM-58). */
export function deleteTappet(cam: CamTable, { track, index }: TappetPlace): CamTable {
  const rest = without(cam.tracks[track]!, index);
  const tracks =
    rest.tappets.length > 0 ? replaced(cam.tracks, track, rest) : cam.tracks.filter((_, at) => at !== track);
  return { ...cam, tracks };
}

/** Moves a tappet to the track with an id, which is made where there is none (CAM-57). */
export function moveToTrack(cam: CamTable, place: TappetPlace, id: number): Placed {
  const tappet = tappetOf(cam, place)!;
  if (cam.tracks[place.track]!.id === id) return { cam, place };
  const tracks = cam.tracks.some((track) => track.id === id) ? cam.tracks : [...cam.tracks, { id, tappets: [] }];
  const rest = deleteTappet({ ...cam, tracks }, place);
  const track = rest.tracks.findIndex((one) => one.id === id);
  const added = withTappet(rest.tracks[track]!, tappet);
  return { cam: { ...rest, tracks: replaced(rest.tracks, track, added.track) }, place: { track, index: added.index } };
}

/** The least id that no track has. */
export function unusedId(cam: CamTable): number {
  const used = new Set(cam.tracks.map((track) => track.id));
  let id = 1;
  while (used.has(id)) id++;
  return id;
}

/** A new track with one tappet at position 0 of the master, or where the range comes next to it (CAM-59). */
export function addTrack(cam: CamTable): Placed {
  const tracks = [...cam.tracks, { id: unusedId(cam), tappets: [] }];
  return addTappet({ ...cam, tracks }, tracks.length - 1, 0);
}

/** Whether a track can be called so: a whole number from 1 on that no other track has. */
export function mayBeTrackId(cam: CamTable, track: number, id: number): boolean {
  return isTrackId(id) && !cam.tracks.some((one, at) => one.id === id && at !== track);
}

export function isTrackId(id: number): boolean {
  return Number.isInteger(id) && id >= 1 && id <= LAST_TRACK;
}

export function setTrackId(cam: CamTable, track: number, id: number): CamTable {
  return { ...cam, tracks: replaced(cam.tracks, track, { ...cam.tracks[track]!, id }) };
}

/** The next id up or down that no other track has (CAM-51); null where there is none. */
export function nextTrackId(cam: CamTable, track: number, step: 1 | -1): number | null {
  let id = cam.tracks[track]!.id + step;
  while (isTrackId(id) && !mayBeTrackId(cam, track, id)) id += step;
  return isTrackId(id) ? id : null;
}
