import { useEffect, useRef, useState } from 'react';

/** What may stand in a cell: it replaces everything from `start` up to the caret. */
export interface Proposal {
  readonly label: string;
  readonly detail: string;
  readonly insert: string;
  readonly start: number;
}

/** Proposals for a text with the caret in it, best first. */
export type Propose = (text: string, caret: number) => Promise<readonly Proposal[]>;

interface Proposals {
  readonly items: readonly Proposal[];
  /** The one that Enter takes; -1 for none. */
  readonly at: number;
  readonly ask: (text: string, caret: number, wanted: boolean) => void;
  readonly move: (by: 1 | -1) => void;
  readonly close: () => void;
}

const NONE: { items: readonly Proposal[]; at: number } = { items: [], at: -1 };
const WORD = /[\p{L}\p{N}_]/u;

/** Keeps the proposals of an open cell; answers that come late are dropped. */
export function useProposals(propose: Propose | undefined): Proposals {
  const [shown, setShown] = useState(NONE);
  const asked = useRef(0);
  useEffect(
    () => () => {
      asked.current += 1;
    },
    [],
  );
  const close = () => {
    asked.current += 1;
    setShown(NONE);
  };
  const ask = (text: string, caret: number, wanted: boolean) => {
    const before = text.slice(0, caret);
    // Without a wish, only a word or a dot that has just been typed asks.
    if (propose === undefined || (!wanted && !WORD.test(before.slice(-1)) && !before.endsWith('.'))) {
      close();
      return;
    }
    asked.current += 1;
    const mine = asked.current;
    // Until the answer is there, Enter takes what is typed.
    setShown(({ items }) => ({ items, at: -1 }));
    propose(text, caret).then(
      (items) => {
        if (mine === asked.current) setShown({ items, at: preselected(items, before, wanted) });
      },
      () => undefined,
    );
  };
  const move = (by: 1 | -1) =>
    setShown(({ items, at }) => ({
      items,
      at: at < 0 && by < 0 ? items.length - 1 : (at + by + items.length) % items.length,
    }));
  return { ...shown, ask, move, close };
}

/** Enter takes the first at once, unless nothing is typed of it or all of it is. */
export function preselected(items: readonly Proposal[], before: string, wanted: boolean): number {
  const [first] = items;
  if (first === undefined) return -1;
  const typed = before.slice(first.start).toUpperCase();
  if (items.some((item) => item.label.toUpperCase() === typed || item.insert.toUpperCase() === typed)) return -1;
  return typed === '' && !wanted ? -1 : 0;
}
