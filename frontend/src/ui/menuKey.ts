/** The keys that open the context menu of what has the focus, in lists that mark their place by aria-activedescendant. */

export function isMenuKey(event: { key: string; shiftKey: boolean }): boolean {
  return (event.key === 'F10' && event.shiftKey) || event.key === 'ContextMenu';
}

/** Opens the context menu around `place` as a right click below it would. */
export function openMenuAt(place: Element): void {
  const box = place.getBoundingClientRect();
  place.dispatchEvent(
    new MouseEvent('contextmenu', {
      bubbles: true,
      cancelable: true,
      clientX: box.left + Math.min(16, box.width / 2),
      clientY: box.bottom,
    }),
  );
}

/** The row or cell that has the cursor in such a list, or the list itself. */
export function activeDescendant(list: Element): Element {
  return document.getElementById(list.getAttribute('aria-activedescendant') ?? '') ?? list;
}
