import { useEffect, useMemo, useState } from 'react';
import { NO_PATH, pathServer, PathView, type PathState, type Wanted } from './pathView';

/** Typing is not followed by each letter. */
const PAUSE_MS = 120;

export interface ShownPath {
  readonly state: PathState;
  readonly view: PathView;
}

/** The view of a program's path on the server, as long as it is wanted. */
export function usePathView(projectId: string, objectId: string, wanted: Wanted, visible: boolean): ShownPath {
  const [state, setState] = useState<PathState>(NO_PATH);
  const view = useMemo(() => new PathView(pathServer(projectId, objectId), setState), [projectId, objectId]);
  useEffect(() => {
    view.open();
    return () => view.close();
  }, [view]);
  const { version } = wanted;
  const looks = JSON.stringify(wanted.looks);
  // The line goes at once, what has to be decoded when the hands rest.
  const [settled, setSettled] = useState(version);
  useEffect(() => {
    const timer = setTimeout(() => setSettled(version), PAUSE_MS);
    return () => clearTimeout(timer);
  }, [version]);
  useEffect(() => {
    if (visible) view.show({ ...wanted, version: settled });
    // `wanted` is made anew with every drawing; these say whether it is another one.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [view, visible, settled, looks, wanted.line]);
  return { state, view };
}
