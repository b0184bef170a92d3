import { MONITORING_MS } from '@/workbench/online/poll';
import { useCallback, useEffect, useRef, useState, useSyncExternalStore } from 'react';
import type { ImagePlace } from '@/api/types';
import { useOnline, type OnlineSession } from '@/workbench/onlineSession';
import type { LiveValue } from './board';
import type { GroupHandle } from './channel';
import { channelOf } from './connections';
import { overlaps, type SubscribedItem } from './item';
import { symbolTree, type SymbolTree } from './symbols';

/** The latest value of one expression; draws again only when it changes. Somebody must watch it. */
export function useLiveValue(runtimeId: string | null, expression: string): LiveValue | null {
  const board = channelOf(runtimeId)?.board ?? null;
  const subscribe = useCallback(
    (listener: () => void) => board?.subscribe(expression, listener) ?? (() => undefined),
    [board, expression],
  );
  return useSyncExternalStore(subscribe, () => board?.get(expression) ?? null);
}

/** The latest value of a BOOL, false before the first one. Somebody must watch it. */
export function useFlag(runtimeId: string | null, expression: string): boolean {
  return useLiveValue(runtimeId, expression)?.value === true;
}

/** The latest value of a number of up to 32 bits or a REAL, null before the first one. Somebody must watch it. */
export function useLiveNumber(runtimeId: string | null, expression: string): number | null {
  const value = useLiveValue(runtimeId, expression)?.value;
  return typeof value === 'number' ? value : null;
}

/** What the server says about one expression; values do not draw again. Somebody must watch it. */
export function useLiveItem(runtimeId: string | null, expression: string): SubscribedItem | null {
  const board = channelOf(runtimeId)?.board ?? null;
  const subscribe = useCallback(
    (listener: () => void) => board?.subscribeItem(expression, listener) ?? (() => undefined),
    [board, expression],
  );
  return useSyncExternalStore(subscribe, () => board?.get(expression)?.item ?? null);
}

/** Watches expressions while the component is there; what is watched may change with every drawing. */
export function useWatched(runtimeId: string | null, expressions: readonly string[], intervalMs = MONITORING_MS): void {
  const handle = useRef<GroupHandle | null>(null);
  const wanted = useRef(expressions);
  useEffect(() => {
    wanted.current = expressions;
    handle.current?.update(expressions);
  });
  useEffect(() => {
    const channel = channelOf(runtimeId);
    if (channel === null) return;
    handle.current = channel.watch(wanted.current, intervalMs);
    return () => {
      handle.current?.release();
      handle.current = null;
    };
  }, [runtimeId, intervalMs]);
}

/** Whether a force holds the variable that an item shows, or a part of it. */
export function isForced(item: SubscribedItem | undefined, forces: readonly ImagePlace[] | undefined): boolean {
  const place = item?.place;
  return place != null && forces !== undefined && forces.some((force) => overlaps(place, force));
}

export function useForced(runtimeId: string | null, expression: string): boolean {
  const item = useLiveItem(runtimeId, expression);
  return useOnline((state) => runtimeId !== null && isForced(item ?? undefined, state.forcedPlaces[runtimeId]));
}

/** The variables of the application that is loaded in the session's runtime. */
export function useSymbols(session: OnlineSession | null): SymbolTree | null {
  const runtimeId = session?.runtimeId ?? null;
  const codeId = session?.runtime?.code_id ?? null;
  return runtimeId === null ? null : symbolTree(runtimeId, codeId);
}

/** Upper-case names below a path; null until they are known. */
export function useMemberNames(tree: SymbolTree | null, path: string | null): ReadonlySet<string> | null {
  const [names, setNames] = useState<{ tree: SymbolTree; path: string; names: ReadonlySet<string> } | null>(null);
  useEffect(() => {
    if (tree === null || path === null) return;
    let current = true;
    tree.children(path).then(
      (children) => {
        if (current) setNames({ tree, path, names: new Set(children.map((child) => child.name.toUpperCase())) });
      },
      () => undefined,
    );
    return () => {
      current = false;
    };
  }, [tree, path]);
  return names !== null && names.tree === tree && names.path === path ? names.names : null;
}
