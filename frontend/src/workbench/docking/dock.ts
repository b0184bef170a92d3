/**
 * The docking area as the rest of the program sees it: open an object, show a panel, close, reset the layout.
 *
 * `DockArea.tsx` hands the dockview API over when it is mounted; before that, calls do nothing.
 */
import type {
  AddPanelOptions,
  DockviewApi,
  DockviewGroupPanel,
  IDockviewPanel,
  SerializedDockview,
} from 'dockview-react';
import { t } from '@/i18n';
import type { Reveal } from '@/project/editorProps';
import { firstFocusable } from '../areas';
import { defaultLayout, editorPanelId, type EditorParams } from './layout';
import { allPanels, findPanel, type DockPosition } from '../panels';
import type { Place } from '@/project/place';
import { isEditor, withDockSizes } from './docks';

let api: DockviewApi | null = null;
let serial = 0;

export function setDockApi(next: DockviewApi | null): void {
  api = next;
}

export function dockApi(): DockviewApi | null {
  return api;
}

export interface OpenOptions {
  /** Jump to this place. */
  place?: Omit<Place, 'objectId'>;
  /** Online: which instance of a function block the editor shows. */
  instance?: string | null;
  /** Give the editor the keyboard focus; true by default. */
  focus?: boolean;
  /** Open beside the active editor instead of in its group. */
  beside?: boolean;
}

/** Opens the object in its editor, or raises the tab that shows it already, and jumps to the place. */
export function openObject(objectId: string, title: string, options: OpenOptions = {}): void {
  if (!api) return;
  const instance = options.instance ?? null;
  const focus = options.focus ?? true;
  const reveal: Reveal | null = options.place || focus ? { ...options.place, serial: ++serial, focus } : null;
  const id = editorPanelId(objectId, instance);
  const params: EditorParams = { objectId, instance, reveal };
  const open = api.getPanel(id);
  if (open) {
    open.api.updateParameters(params);
    open.api.setActive();
    return;
  }
  const group = editorGroup(api);
  api.addPanel({
    id,
    component: 'editor',
    tabComponent: 'editor',
    title,
    params,
    position:
      options.beside && group?.panels.length ? { referenceGroup: group, direction: 'right' } : groupPosition(group),
  });
}

function groupPosition(group: DockviewGroupPanel | undefined): AddPanelOptions['position'] {
  return group ? { referenceGroup: group, direction: 'within' } : undefined;
}

/** The group new editors open in: the one used last, else the first that holds editors or is empty. */
function editorGroup(dock: DockviewApi): DockviewGroupPanel | undefined {
  const isEditorGroup = (group: DockviewGroupPanel) => group.panels.length === 0 || group.panels.some(isEditor);
  const active = dock.activeGroup;
  if (active && active.panels.length > 0 && isEditorGroup(active)) return active;
  const groups = dock.groups.filter((group) => group.api.location.type === 'grid' && isEditorGroup(group));
  return groups.find((group) => group.id === lastEditorGroup) ?? groups[0];
}

let lastEditorGroup: string | null = null;

/** `DockArea` remembers the group of the editor that was active last. */
export function editorGroupUsed(groupId: string): void {
  lastEditorGroup = groupId;
}

/** Shows a tool panel: raises it, or opens it in its dock. */
export function showPanel(id: string, focus = true): void {
  if (!api) return;
  const open = api.getPanel(id);
  if (open) {
    if (!open.group.api.isVisible) open.group.api.setVisible(true);
    open.api.setActive();
    if (focus) focusPanel(open);
    return;
  }
  const registration = findPanel(id);
  if (!registration) return;
  const dock = api;
  withDockSizes(dock, () => {
    const added = dock.addPanel({
      id,
      component: 'tool',
      tabComponent: 'tool',
      title: t(registration.title, registration.titleValues),
      position: dockSpot(dock, registration.position),
      ...(registration.position === 'bottom' ? { initialHeight: 240 } : { initialWidth: 320 }),
    });
    if (focus) focusPanel(added);
  });
}

/** Moves the keyboard focus into a panel: to the element marked `data-autofocus`, else to the first that takes it. */
export function focusPanel(panel: IDockviewPanel): void {
  requestAnimationFrame(() => {
    const element = panel.view.content.element;
    if (element.contains(document.activeElement)) return;
    firstFocusable(element)?.focus();
  });
}

/** Where a tool panel goes: to its fellows of the same dock, else a new group at that edge. */
function dockSpot(dock: DockviewApi, position: DockPosition): AddPanelOptions['position'] {
  const fellow = dock.panels.find(
    (panel) => findPanel(panel.id)?.position === position && panel.group.api.location.type === 'grid',
  );
  if (fellow) return { referenceGroup: fellow.group, direction: 'within' };
  // The bottom dock runs below everything, the others stand beside the editors.
  const editors = editorGroup(dock);
  if (position === 'bottom' || !editors) return { direction: position === 'bottom' ? 'below' : position };
  return { referenceGroup: editors, direction: position };
}

export function closePanel(id: string): void {
  const panel = api?.getPanel(id);
  if (panel) panel.api.close();
}

/** Puts every panel back to where it was at the start; open editors stay open. */
export function resetLayout(): void {
  if (!api) return;
  const editors = api.panels.filter(isEditor);
  const layout = defaultLayout(
    allPanels(),
    (panel) => t(panel.title, panel.titleValues),
    { width: api.width, height: api.height },
    editors.map((panel) => ({ id: panel.id, title: panel.title ?? '', params: panel.params as EditorParams })),
  );
  applyLayout(layout);
}

function applyLayout(layout: SerializedDockview): void {
  api?.fromJSON(layout);
}

/** Closes the editors of objects that no longer exist. */
export function closePanelsOf(objectIds: readonly string[]): void {
  const gone = new Set(objectIds);
  for (const panel of [...(api?.panels ?? [])]) {
    if (isEditor(panel) && gone.has((panel.params as EditorParams).objectId)) panel.api.close();
  }
}
