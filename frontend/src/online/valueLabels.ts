/**
 * Names and texts of elements whose value is painted, for who reads the page by other means; each changes once a second
 * at most: more would cost as much as the painting, and a screen reader that follows a cell would never finish a number.
 */

/** Least time between two names of an element, in ms. */
export const LABEL_MS = 1000;
/** Elements named since the timer last went off, and what those are called that have changed again since. */
const recent = new Set<Element>();
const waiting = new Map<Element, string>();
let timer: ReturnType<typeof setTimeout> | undefined;

/** Names `element` by its value: at once, or with all others that have just been named. */
export function labelValue(element: Element, text: string): void {
  if (recent.has(element)) {
    waiting.set(element, text);
    return;
  }
  if (element.getAttribute('aria-label') === text) return;
  name(element, text);
  timer ??= setTimeout(writeWaiting, LABEL_MS);
}

/** The element shows no value any more. */
export function unlabelValue(element: Element): void {
  recent.delete(element);
  waiting.delete(element);
  element.removeAttribute('aria-label');
  element.textContent = '';
}

function name(element: Element, text: string): void {
  element.setAttribute('aria-label', text);
  element.textContent = text;
  recent.add(element);
}

function writeWaiting(): void {
  recent.clear();
  for (const [element, text] of waiting) name(element, text);
  waiting.clear();
  timer = recent.size > 0 ? setTimeout(writeWaiting, LABEL_MS) : undefined;
}
