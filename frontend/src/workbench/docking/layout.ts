/** The layout as plain data: the default one, and the check of a stored one. Pure functions. */
import type { SerializedDockview } from 'dockview-react';
import type { Reveal } from '@/project/editorProps';
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
const VERTICAL = 'VERTICAL' as SerializedDockview['grid']['orientation'];

/** Trees at the left, editors in the middle, the rest at the right; messages and watch lists below, over the whole width. */
export function defaultLayout(
  panels: readonly PanelRegistration[],
  titleOf: (panel: PanelRegistration) => string,
  size: Size,
  editors: readonly LayoutEditor[] = [],
): SerializedDockview {
  const initial = panels.filter((panel) => panel.initial);
  const idsAt = (position: DockPosition) =>
    initial.filter((panel) => panel.position === position).map((panel) => panel.id);
  const leftWidth = idsAt('left').length ? LEFT_WIDTH : 0;
  const rightWidth = idsAt('right').length ? RIGHT_WIDTH : 0;
  const bottomHeight = idsAt('bottom').length ? Math.min(BOTTOM_HEIGHT, Math.round(size.height * 0.35)) : 0;
  const upper: Node[] = [
    leaf(
      EDITORS_GROUP,
      editors.map((editor) => editor.id),
      size.width - leftWidth - rightWidth,
    ),
  ];
  if (leftWidth) upper.unshift(leaf('left', idsAt('left'), leftWidth));
  if (rightWidth) upper.push(leaf('right', idsAt('right'), rightWidth));
  const rows: Node[] = [{ type: 'branch', size: size.height - bottomHeight, data: upper }];
  if (bottomHeight) rows.push(leaf('bottom', idsAt('bottom'), bottomHeight));
  const tools = initial.map((panel) => [
    panel.id,
    { id: panel.id, contentComponent: 'tool', tabComponent: 'tool', title: titleOf(panel) },
  ]);
  const open = editors.map((editor) => [
    editor.id,
    {
      id: editor.id,
      contentComponent: 'editor',
      tabComponent: 'editor',
      title: editor.title,
      params: { ...editor.params },
    },
  ]);
  return {
    grid: {
      root: { type: 'branch', size: size.width, data: rows },
      width: size.width,
      height: size.height,
      orientation: VERTICAL,
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

export interface LayoutWorld {
  panelExists: (id: string) => boolean;
  objectExists: (objectId: string) => boolean;
  /** Room that the docking area has now. */
  size: Size;
}

/**
 * A stored layout made fit for use: panels that no longer exist and editors whose object is gone are taken out, and
 * docks keep their size in another window, the editors take what is left. Null when the blob is no layout of this version.
 */
export function restoreLayout(
  stored: unknown,
  { panelExists, objectExists, size }: LayoutWorld,
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
  const root = withoutViews(dock.grid.root, gone) ?? leaf(EDITORS_GROUP, [], dock.grid.width);
  // The root of a grid is a branch, whatever is left of it.
  const whole: Node = root.type === 'branch' ? root : { type: 'branch', size: dock.grid.width, data: [root] };
  const { popoutGroups: _windows, ...rest } = dock;
  return {
    ...rest,
    grid: {
      ...dock.grid,
      root: fitted(whole, dock.grid.orientation === VERTICAL, size),
      width: size.width,
      height: size.height,
    },
    panels: panels as SerializedDockview['panels'],
    floatingGroups: [...floating(dock.floatingGroups, gone), ...floating(dock.popoutGroups, gone)],
  };
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

function withoutViews(node: Node, gone: ReadonlySet<string>): Node | null {
  if (node.type === 'leaf') {
    const before = node.data as unknown as GroupData;
    const after = pruned(before, gone);
    // A group that only lost its panels goes; the empty editor area is kept.
    if (after.views.length === 0 && before.views.length > 0 && before.id !== EDITORS_GROUP) return null;
    return { ...node, data: after };
  }
  const children = (node.data as Node[]).map((child) => withoutViews(child, gone)).filter((child) => child !== null);
  return children.length === 0 ? null : { ...node, data: children };
}

/** Whether editors live in this part of the grid: it may grow and shrink with the window. */
function holdsEditors(node: Node): boolean {
  if (node.type === 'branch') return (node.data as Node[]).some(holdsEditors);
  const { id, views } = node.data as unknown as GroupData;
  return id === EDITORS_GROUP || views.some((view) => view.startsWith('editor:'));
}

/**
 * The tree with sizes that fill the given room. A branch's own size is that across its direction, its children divide
 * the room along it: docks as before, but never all of it, the editors take the rest.
 */
function fitted(node: Node, vertical: boolean, room: Size): Node {
  if (node.type === 'leaf') return node;
  const children = node.data as Node[];
  const along = vertical ? room.height : room.width;
  const across = vertical ? room.width : room.height;
  const elastic = children.filter(holdsEditors);
  const docks = children.filter((child) => !elastic.includes(child));
  const sum = (nodes: readonly Node[]) => nodes.reduce((total, child) => total + (child.size ?? 0), 0);
  const dockSpace = elastic.length ? Math.min(sum(docks), along * 0.7) : along;
  const scale = (child: Node) => {
    const group = elastic.includes(child) ? elastic : docks;
    const space = elastic.includes(child) ? along - dockSpace : dockSpace;
    return Math.round(((child.size ?? 0) / (sum(group) || 1)) * space);
  };
  const data = children.map((child): Node => {
    const share = scale(child);
    const inner = vertical ? { width: room.width, height: share } : { width: share, height: room.height };
    return { ...fitted(child, !vertical, inner), size: share };
  });
  return { ...node, size: across, data };
}

type Floating = NonNullable<SerializedDockview['floatingGroups']>[number];
type Window = NonNullable<SerializedDockview['popoutGroups']>[number];

const FLOAT = { left: 120, top: 80, width: 640, height: 420 };

/**
 * Floating groups that still hold something. Groups in windows of their own come back floating: a browser opens no
 * window that the user did not ask for.
 */
function floating(groups: readonly (Floating | Window)[] | undefined, gone: ReadonlySet<string>): Floating[] {
  return (groups ?? []).flatMap((group): Floating[] => {
    const position = 'gridReferenceGroup' in group || !group.position ? FLOAT : group.position;
    if (group.data) {
      const data = pruned(group.data, gone);
      return data.views.length ? [{ data, position }] : [];
    }
    const root = group.grid && withoutViews(group.grid.root, gone);
    return group.grid && root ? [{ grid: { ...group.grid, root }, position }] : [];
  });
}
