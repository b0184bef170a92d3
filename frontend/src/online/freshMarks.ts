/** Marks what shows a value that has changed lately; one timer serves all. */

/** How long a change is marked, in ms. */
export const FRESH_MS = 1000;
const LOOK_MS = 100;

export interface FreshMark {
  setFresh: (fresh: boolean) => void;
}

const ends = new Map<FreshMark, number>();
let timer: ReturnType<typeof setTimeout> | undefined;

/** Marks until a second after `changedAt` (performance clock, ms); 0 is the first value seen, no change. */
export function markFresh(mark: FreshMark, changedAt: number): void {
  const end = changedAt + FRESH_MS;
  if (changedAt === 0 || end <= performance.now()) return;
  if (!ends.has(mark)) mark.setFresh(true);
  ends.set(mark, end);
  timer ??= setTimeout(look, LOOK_MS);
}

export function unmarkFresh(mark: FreshMark): void {
  if (ends.delete(mark)) mark.setFresh(false);
}

function look(): void {
  const now = performance.now();
  for (const [mark, end] of ends) if (end <= now) unmarkFresh(mark);
  timer = ends.size > 0 ? setTimeout(look, LOOK_MS) : undefined;
}
