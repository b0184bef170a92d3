import { useEffect, useMemo, useState } from 'react';
import type { OnlineSession } from '@/workbench/onlineSession';
import type { SymbolChild, SymbolTree } from './symbols';
import { flatten, type ChildrenByPath, type OnlineRoot } from './treeRows';
import { useSymbols } from './useLive';

const NOTHING: ChildrenByPath = new Map();

/** Components of all opened rows; they are read when a row opens, and again for another application. */
export function useChildren(
  session: OnlineSession | null,
  roots: readonly OnlineRoot[],
  open: ReadonlySet<string>,
): ChildrenByPath {
  const tree = useSymbols(session);
  const [read, setRead] = useState<{ tree: SymbolTree | null; children: ChildrenByPath }>({
    tree: null,
    children: NOTHING,
  });
  const children = read.tree === tree ? read.children : NOTHING;
  const missing = useMemo(
    () =>
      flatten(roots, open, children)
        .filter((row) => row.open === true && !children.has(row.expression.toUpperCase()))
        .map((row) => row.expression),
    [roots, open, children],
  );
  useEffect(() => {
    if (tree === null || missing.length === 0) return;
    let current = true;
    const ask = async (path: string): Promise<[string, readonly SymbolChild[]]> => [
      path.toUpperCase(),
      await tree.children(path).catch(() => []),
    ];
    void Promise.all(missing.map(ask)).then((answers) => {
      if (!current) return;
      setRead((before) => ({
        tree,
        children: new Map([...(before.tree === tree ? before.children : NOTHING), ...answers]),
      }));
    });
    return () => {
      current = false;
    };
  }, [tree, missing]);
  return children;
}
