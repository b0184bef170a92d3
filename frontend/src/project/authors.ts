/** Who made the revisions of objects that came by the events socket: undo takes back one's own work only. */

const own = new Map<string, number>();
const foreign = new Map<string, number>();

/** A revision was made: by who sits here, or by somebody else. */
export function revisionMade(objectId: string, revision: number, byOthers: boolean): void {
  (byOthers ? foreign : own).set(objectId, revision);
}

/**
 * Whether somebody else had a part in what led from a revision of an object to a newer one. What no event told, in a
 * gap of the connection, may have been anybody.
 */
export function changedByOthers(objectId: string, since: number, now: number): boolean {
  return (foreign.get(objectId) ?? 0) > since || own.get(objectId) !== now;
}
