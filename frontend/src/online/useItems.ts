import { useEffect, useState } from 'react';
import { channelOf } from './connections';
import { valueKind } from './item';

export interface ItemFacts {
  type: string;
  kind: string;
  leaf: boolean;
  section?: string;
  flags?: readonly string[];
  error?: string;
}

const NOTHING: ReadonlyMap<string, ItemFacts> = new Map();

/**
 * What the runtime says about expressions whose type is not known beforehand (watch lists). It is asked once for a
 * loaded application (`codeId`): after that, rows that are not on screen cost nothing.
 */
export function useItems(
  runtimeId: string | null,
  codeId: string | null,
  expressions: readonly string[],
): ReadonlyMap<string, ItemFacts> {
  const [items, setItems] = useState<ReadonlyMap<string, ItemFacts>>(new Map());
  const asked = expressions.join('\n');
  useEffect(() => {
    const channel = channelOf(runtimeId);
    if (channel === null || asked === '') return;
    const wanted = asked.split('\n').filter((expression) => expression !== '');
    const missing = new Set(wanted);
    const read = () => {
      const next = new Map<string, ItemFacts>();
      for (const expression of wanted) {
        const item = channel.board.get(expression)?.item;
        if (item === undefined) continue;
        missing.delete(expression);
        const kind = valueKind(item);
        next.set(expression, {
          type: item.type,
          kind: item.kind,
          leaf: kind !== 'compound',
          section: item.section,
          flags: item.flags,
          ...(item.error != null && item.error !== '' && { error: item.error }),
        });
      }
      setItems((before) => {
        // What is not watched any more is what it was.
        for (const expression of wanted) {
          const known = next.has(expression) ? undefined : before.get(expression);
          if (known !== undefined) next.set(expression, known);
        }
        return sameFacts(before, next) ? before : next;
      });
      if (missing.size === 0) watching.release();
    };
    const watching = channel.watch(wanted, 1000);
    const stops = wanted.map((expression) => channel.board.subscribeItem(expression, read));
    queueMicrotask(read);
    return () => {
      stops.forEach((stop) => stop());
      watching.release();
    };
  }, [runtimeId, codeId, asked]);
  return runtimeId === null || asked === '' ? NOTHING : items;
}

function sameFacts(a: ReadonlyMap<string, ItemFacts>, b: ReadonlyMap<string, ItemFacts>): boolean {
  if (a.size !== b.size) return false;
  for (const [expression, facts] of b) {
    const before = a.get(expression);
    if (
      before === undefined ||
      before.type !== facts.type ||
      before.kind !== facts.kind ||
      before.error !== facts.error
    )
      return false;
  }
  return true;
}
