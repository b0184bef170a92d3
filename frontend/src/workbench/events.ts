/**
 * The events socket of a project: what others change reaches the caches at once; who is here is shown in the frame.
 */
import { create } from 'zustand';
import { socketUrl } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary, ProjectObject } from '@/api/types';
import { applyChange, type ObjectEvent } from './tree/changes';

export interface PresentUser {
  username: string;
  object_id: string | null;
}

interface Presence {
  users: readonly PresentUser[];
  connected: boolean;
}

export const usePresence = create<Presence>(() => ({ users: [], connected: false }));

type EventMessage = ObjectEvent | { op: 'presence'; users: PresentUser[] };

const FIRST_PAUSE_MS = 500;
const LONGEST_PAUSE_MS = 15_000;

export interface ProjectEvents {
  /** Tells the others which object is looked at; null for none. */
  look(objectId: string | null): void;
  close(): void;
}

/** Connects and keeps connecting; after a gap the tree is read anew, since changes may have been missed. */
export function openEvents(projectId: string, objectChanged: () => void): ProjectEvents {
  let socket: WebSocket | null = null;
  let closed = false;
  let pause = FIRST_PAUSE_MS;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let looking: string | null = null;

  const send = () => {
    if (socket?.readyState === WebSocket.OPEN) socket.send(JSON.stringify({ op: 'open', object_id: looking }));
  };
  const connect = (again: boolean) => {
    socket = new WebSocket(socketUrl('/events', { project: projectId }));
    socket.onopen = () => {
      pause = FIRST_PAUSE_MS;
      usePresence.setState({ connected: true });
      if (again) void queryClient.invalidateQueries({ queryKey: keys.project(projectId) });
      send();
    };
    socket.onmessage = (event) => {
      const message = JSON.parse(String(event.data)) as EventMessage;
      receive(projectId, message);
      if (message.op === 'object') objectChanged();
    };
    socket.onclose = () => {
      usePresence.setState({ connected: false, users: [] });
      if (closed) return;
      timer = setTimeout(() => connect(true), pause);
      pause = Math.min(pause * 2, LONGEST_PAUSE_MS);
    };
  };
  connect(false);
  return {
    look: (objectId) => {
      looking = objectId;
      send();
    },
    close: () => {
      closed = true;
      clearTimeout(timer);
      socket?.close();
    },
  };
}

function receive(projectId: string, message: EventMessage): void {
  if (message.op === 'presence') {
    usePresence.setState({ users: message.users });
    return;
  }
  queryClient.setQueryData<ObjectSummary[]>(
    keys.objects(projectId),
    (objects) => objects && applyChange(objects, message),
  );
  const key = keys.object(projectId, message.object.id);
  if (message.change === 'deleted') queryClient.removeQueries({ queryKey: key });
  else {
    const known = queryClient.getQueryData<ProjectObject>(key);
    if (known && known.revision < message.object.revision) void queryClient.invalidateQueries({ queryKey: key });
  }
}
