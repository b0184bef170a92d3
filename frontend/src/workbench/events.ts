/**
 * The events socket of a project: what others change reaches the caches at once; who is here is shown in the frame.
 */
import { create } from 'zustand';
import { socketUrl } from '@/api/client';
import { ReconnectingSocket } from '@/api/socket';
import { keys, objectQuery, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { revisionMade } from '@/project/authors';
import { applyChange, type ObjectEvent } from '@/project/changes';
import { useSession } from '@/session/session';
import { withChange, type PresenceChange, type PresentUser } from './presence';

interface Presence {
  users: readonly PresentUser[];
  connected: boolean;
}

export const usePresence = create<Presence>(() => ({ users: [], connected: false }));

type EventMessage =
  ObjectEvent | { op: 'presence'; users: readonly PresentUser[] } | ({ op: 'presence_changed' } & PresenceChange);

export interface ProjectEvents {
  /** Shows the other users which object is open; null for none. */
  look(objectId: string | null): void;
  close(): void;
}

/** After a gap in the connection the tree is fetched again, since changes may have been missed. */
export function openEvents(projectId: string, objectChanged: () => void): ProjectEvents {
  let looking: string | null = null;
  const socket = new ReconnectingSocket(socketUrl('/events', { project: projectId }), {
    opened: (again) => {
      usePresence.setState({ connected: true });
      if (again) void queryClient.invalidateQueries({ queryKey: keys.project(projectId) });
      look(looking);
    },
    message: (data) => {
      const message = JSON.parse(String(data)) as EventMessage;
      receive(projectId, message);
      if (message.op === 'object') objectChanged();
    },
    lost: () => usePresence.setState({ connected: false, users: [] }),
  });
  const look = (objectId: string | null) => {
    looking = objectId;
    socket.send({ op: 'open', object_id: objectId });
  };
  const close = () => {
    socket.close();
    usePresence.setState({ connected: false, users: [] });
  };
  return { look, close };
}

function receive(projectId: string, message: EventMessage): void {
  if (message.op === 'presence') {
    usePresence.setState({ users: message.users });
    return;
  }
  if (message.op === 'presence_changed') {
    usePresence.setState(({ users }) => ({ users: withChange(users, message) }));
    return;
  }
  const { id, revision } = message.object;
  revisionMade(id, revision, message.author !== useSession.getState().user?.username);
  queryClient.setQueryData<ObjectSummary[]>(
    keys.objects(projectId),
    (objects) => objects && applyChange(objects, message),
  );
  void queryClient.invalidateQueries({ queryKey: keys.testRuns(projectId) });
  const key = objectQuery(projectId, message.object.id).queryKey;
  if (message.change === 'deleted') queryClient.removeQueries({ queryKey: key });
  else {
    const known = queryClient.getQueryData(key);
    if (known && known.revision < message.object.revision) void queryClient.invalidateQueries({ queryKey: key });
  }
}
