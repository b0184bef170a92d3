/** Marks elements whose value has changed lately (`data-fresh`); one timer serves all. */

/** How long a change is marked, in ms. */
export const FRESH_MS = 1000;
const LOOK_MS = 100;

const ends = new Map<HTMLElement, number>();
let timer: ReturnType<typeof setTimeout> | undefined;

/** Marks an element until a second after `changedAt` (performance clock, ms); 0 is the first value seen, no change. */
export function markFresh(element: HTMLElement, changedAt: number): void {
  const end = changedAt + FRESH_MS;
  if (changedAt === 0 || end <= performance.now()) return;
  if (!ends.has(element)) element.dataset.fresh = 'true';
  ends.set(element, end);
  timer ??= setTimeout(look, LOOK_MS);
}

export function unmarkFresh(element: HTMLElement): void {
  if (ends.delete(element)) delete element.dataset.fresh;
}

function look(): void {
  const now = performance.now();
  for (const [element, end] of ends) if (end <= now) unmarkFresh(element);
  timer = ends.size > 0 ? setTimeout(look, LOOK_MS) : undefined;
}
