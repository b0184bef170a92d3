/** F6: from one area of the workbench to the next; menus, tool bar, every visible panel, status bar, in reading order. */

const AREAS = '[role="menubar"], [role="toolbar"], [data-panel-id], footer[role="status"]';
const FOCUSABLE =
  '[data-autofocus], textarea.inputarea, [tabindex="0"], input:not(:disabled), select, button:not([tabindex="-1"]), [role="menuitem"], iframe';

/** What takes the keyboard focus when it moves into a part of the page. */
export function firstFocusable(part: Element): HTMLElement | null {
  return part.querySelector<HTMLElement>(FOCUSABLE);
}

function areas(): HTMLElement[] {
  return [...document.querySelectorAll<HTMLElement>(AREAS)]
    .filter((area) => area.getClientRects().length > 0 && area.parentElement?.closest('[data-panel-id]') === null)
    .filter((area) => firstFocusable(area) !== null)
    .map((area) => ({ area, box: area.getBoundingClientRect() }))
    .sort((a, b) => a.box.top - b.box.top || a.box.left - b.box.left)
    .map(({ area }) => area);
}

/** What had the focus last in an area comes first when the focus comes back. */
const last = new WeakMap<HTMLElement, HTMLElement>();

export function stepArea(by: 1 | -1): void {
  const found = areas();
  const active = document.activeElement;
  const at = found.findIndex((area) => area.contains(active));
  if (at >= 0 && active instanceof HTMLElement) last.set(found[at]!, active);
  const next = found[at < 0 ? 0 : (at + by + found.length) % found.length];
  if (next === undefined) return;
  const before = last.get(next);
  const target = before !== undefined && next.contains(before) ? before : firstFocusable(next);
  target?.focus();
}
