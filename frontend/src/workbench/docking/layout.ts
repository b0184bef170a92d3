/** The layout as plain data: the default one, and the check of a stored one. Pure functions. */
import type { SerializedDockview } from 'dockview-react';
import type { Reveal } from '../editors';
import type { DockPosition, PanelRegistration } from '../panels';

/** What an editor tab remembers; `reveal` is not stored. */
export interface EditorParams {
  objectId: string;
  instance: string | null;
  reveal: Reveal | null;
}

export function editorPanelId(objectId: string, instance: string | null): string {
  return instance ? `editor:${objectId}:${instance}` : `editor:${objectId}`;
}

export interface LayoutEditor {
  id: string;
  title: string;
  params: EditorParams;
}

export const EDITORS_GROUP = 'editors';
const LEFT_WIDTH = 280;
const RIGHT_WIDTH = 260;
const BOTTOM_HEIGHT = 220;

interface Size {
  width: number;
  height: number;
}

type Node = SerializedDockview['grid']['root'];

/** Trees at the left, editors in the middle, messages and watch lists below them, the rest at the right. */
export function defaultLayout(
  panels: readonly PanelRegistration[],
  titleOf: (panel: PanelRegistration) => string,
  size: Size,
  editors: readonly LayoutEditor[] = [],
): SerializedDockview {
  const initial = panels.filter((panel) => panel.initial);
  const at = (position: DockPosition) => initial.filter((panel) => panel.position === position);
  const bottomHeight = Math.min(BOTTOM_HEIGHT, Math.round(size.height * 0.35));
  const sides: Node[] = [];
  if (at('left').length) sides.push(leaf('left', at('left').map((panel) => panel.id), LEFT_WIDTH));
  const middle: Node[] = [leaf(EDITORS_GROUP, editors.map((editor) => editor.id), size.height - bottomHeight)];
  if (at('bottom').length) middle.push(leaf('bottom', at('bottom').map((panel) => panel.id), bottomHeight));
  const rightWidth = at('right').length ? RIGHT_WIDTH : 0;
  sides.push({ type: 'branch', size: size.width - LEFT_WIDTH - rightWidth, data: middle });
  if (rightWidth) sides.push(leaf('right', at('right').map((panel) => panel.id), rightWidth));
  const tools = initial.map((panel) => [
    panel.id,
    { id: panel.id, contentComponent: 'tool', tabComponent: 'tool', title: titleOf(panel) },
  ]);
  const open = editors.map((editor) => [
    editor.id,
    { id: editor.id, contentComponent: 'editor', tabComponent: 'editor', title: editor.title, params: { ...editor.params } },
  ]);
  return {
    grid: {
      root: { type: 'branch', size: size.height, data: sides },
      width: size.width,
      height: size.height,
      orientation: 'HORIZONTAL' as SerializedDockview['grid']['orientation'],
    },
    panels: Object.fromEntries([...tools, ...open]) as SerializedDockview['panels'],
    activeGroup: EDITORS_GROUP,
  };
}

function leaf(id: string, views: string[], size: number): Node {
  return { type: 'leaf', size, data: { id, views, activeView: views[0] } };
}

export interface StoredLayout {
  version: 1;
  dock: SerializedDockview;
}

/**
 * A stored layout made fit for use: panels that no longer exist and editors whose object is gone are taken out.
 * Null when the blob is no layout of this version.
 */
export function restoreLayout(
  stored: unknown,
  panelExists: (id: string) => boolean,
  objectExists: (objectId: string) => boolean,
): SerializedDockview | null {
  if (typeof stored !== 'object' || stored === null) return null;
  const { version, dock } = stored as Partial<StoredLayout>;
  if (version !== 1 || typeof dock !== 'object' || !dock.grid?.root || !dock.panels) return null;
  const gone = new Set<string>();
  const panels: Record<string, unknown> = {};
  for (const [id, panel] of Object.entries(dock.panels)) {
    const params = panel.params as Partial<EditorParams> | undefined;
    const alive = panel.contentComponent === 'editor' ? objectExists(params?.objectId ?? '') : panelExists(id);
    if (alive) panels[id] = params ? { ...panel, params: { ...params, reveal: null } } : panel;
    else gone.add(id);
  }
  const root = withoutViews(dock.grid.root, gone, true);
  if (!root) return null;
  return { ...dock, grid: { ...dock.grid, root }, panels: panels as SerializedDockview['panels'], ...withoutFloating(dock, gone) };
}

interface GroupData {
  id: string;
  views: string[];
  activeView?: string;
}

function pruned(group: GroupData, gone: ReadonlySet<string>): GroupData {
  const views = group.views.filter((view) => !gone.has(view));
  const activeView = group.activeView && views.includes(group.activeView) ? group.activeView : views[0];
  return { ...group, views, activeView };
}

function withoutViews(node: Node, gone: ReadonlySet<string>, root = false): Node | null {
  if (node.type === 'leaf') {
    const before = node.data as unknown as GroupData;
    const after = pruned(before, gone);
    // A group that only lost its panels goes; the empty editor area is kept.
    if (after.views.length === 0 && before.views.length > 0 && before.id !== EDITORS_GROUP) return null;
    return { ...node, data: after };
  }
  const children = (node.data as Node[]).map((child) => withoutViews(child, gone)).filter((child) => child !== null);
  if (children.length === 0 && !root) return null;
  return { ...node, data: children };
}

function withoutFloating(dock: SerializedDockview, gone: ReadonlySet<string>): Partial<SerializedDockview> {
  const keep = <Entry extends { data: unknown }>(entries: Entry[] | undefined) =>
    entries
      ?.map((entry) => ({ ...entry, data: pruned(entry.data as GroupData, gone) }))
      .filter((entry) => entry.data.views.length > 0);
  const changed: Record<string, unknown> = {};
  if (dock.floatingGroups) changed.floatingGroups = keep(dock.floatingGroups as { data: unknown }[]);
  if (dock.popoutGroups) changed.popoutGroups = keep(dock.popoutGroups as { data: unknown }[]);
  return changed;
}
