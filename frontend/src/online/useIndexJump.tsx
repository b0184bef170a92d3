import { useEffect, useRef } from 'react';
import { openDialog } from '@/ui/dialogs';
import type { OnlineSession } from '@/workbench/onlineSession';
import { IndexDialog } from './IndexDialog';
import { boundsText, extentOf, locate, type ArrayRow, type Located } from './indexJump';
import { symbolTree } from './symbols';
import type { OnlineRow } from './treeRows';

interface IndexJump {
  session: OnlineSession | null;
  rows: readonly OnlineRow[];
  open: (keys: readonly string[]) => void;
  show: (index: number) => void;
}

/** Asks for the indices of an element of an array, opens the pages down to it and shows its row. */
export function useIndexJump({ session, rows, open, show }: IndexJump): (array: ArrayRow) => Promise<void> {
  /** The row that is to be shown as soon as it is there. */
  const wanted = useRef<string | null>(null);
  useEffect(() => {
    const at = wanted.current === null ? -1 : rows.findIndex(({ key }) => key === wanted.current);
    if (at < 0) return;
    wanted.current = null;
    show(at);
  }, [rows, show]);

  return async (array) => {
    if (session === null) return;
    const tree = symbolTree(session.runtimeId, session.runtime?.code_id ?? null);
    const childrenOf = (path: string) => tree.children(path);
    const extent = extentOf(await childrenOf(array.expression));
    if (extent === null) return;
    const found = await openDialog<Located & { ok: true }>((close) => (
      <IndexDialog
        path={array.expression}
        bounds={boundsText(extent, array.kind === 'part')}
        find={(text) => locate(childrenOf, array, text)}
        close={close}
      />
    ));
    if (found === undefined) return;
    wanted.current = found.key;
    open(found.opened);
  };
}
