/** Who has a project open: the list that the server sends once, and what changes in it. */
import type { Schemas } from '@/api/types';

export type PresentUser = Schemas['PresentUser'];
export type PresenceChange = Omit<Schemas['PresenceChanged'], 'op'>;

/** The list after a change: who was there keeps the place, whoever is new comes last. */
export function withChange(users: readonly PresentUser[], change: PresenceChange): readonly PresentUser[] {
  const after = new Map(users.map((user) => [user.id, user]));
  for (const id of change.left) after.delete(id);
  for (const user of change.present) after.set(user.id, user);
  return [...after.values()];
}
