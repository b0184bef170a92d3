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

/** What the runtime says about expressions whose type is not known beforehand (watch lists). */
export function useItems(runtimeId: string | null, expressions: readonly string[]): ReadonlyMap<string, ItemFacts> {
  const [items, setItems] = useState<ReadonlyMap<string, ItemFacts>>(new Map());
  const asked = expressions.join('\n');
  useEffect(() => {
    const channel = channelOf(runtimeId);
    if (channel === null || asked === '') return;
    const wanted = asked.split('\n').filter((expression) => expression !== '');
    const read = () => {
      const next = new Map<string, ItemFacts>();
      for (const expression of wanted) {
        const item = channel.board.get(expression)?.item;
        if (item === undefined) continue;
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
      setItems((before) => (sameFacts(before, next) ? before : next));
    };
    const watching = channel.watch(wanted, 1000);
    const stops = wanted.map((expression) => channel.board.subscribe(expression, read));
    queueMicrotask(read);
    return () => {
      stops.forEach((stop) => stop());
      watching.release();
    };
  }, [runtimeId, asked]);
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
