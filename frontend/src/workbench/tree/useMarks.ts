import { useMemo } from 'react';
import type { ObjectSummary } from '@/api/types';
import { presentMessages, useMessages } from '../messages/store';
import { useOnline } from '../onlineSession';
import { marksOf, type Mark } from './marks';

/** Marks of the objects, as messages and forces come and go. */
export function useMarks(objects: readonly ObjectSummary[]): ReadonlyMap<string, Mark> {
  const { build, live } = useMessages();
  const { sessions, forces } = useOnline();
  return useMemo(() => {
    const forced = new Map(
      Object.values(sessions).map((session) => [session.applicationId, forces[session.runtimeId] ?? []]),
    );
    return marksOf(objects, presentMessages(build, live), forced);
  }, [objects, build, live, sessions, forces]);
}
