/** Where the keyboard was before a menu had it: a dialog that an entry opens leads back there. */

const origins = new WeakMap<Element, Element>();

/** Remembers what had the focus when a context menu opened; other menus are labelled by their buttons. */
export function setMenuOrigin(menu: Element, place: Element | null): void {
  if (place !== null && place !== document.body) origins.set(menu, place);
}

/** What opened a menu, or had the focus before; null where neither is known. */
export function menuOrigin(menu: Element): Element | null {
  return origins.get(menu) ?? document.getElementById(menu.getAttribute('aria-labelledby') ?? '');
}
