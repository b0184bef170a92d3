import type { SerializedDockview } from 'dockview-react';
import { describe, expect, it } from 'vitest';
import type { PanelRegistration } from '../panels';
import { defaultLayout, editorPanelId, restoreLayout } from './layout';

const panel = (id: string, position: PanelRegistration['position'], initial = true): PanelRegistration => ({
  id,
  position,
  initial,
  title: 'panel.messages',
  order: 1,
  icon: () => null,
  component: () => null,
});
const PANELS = [
  panel('devices', 'left'),
  panel('pous', 'left'),
  panel('messages', 'bottom'),
  panel('doc', 'right', false),
];
const SIZE = { width: 1400, height: 800 };
const editor = (objectId: string) => ({
  id: editorPanelId(objectId, null),
  title: objectId,
  params: { objectId, instance: null, reveal: null },
});
const layout = () => defaultLayout(PANELS, (one) => one.id, SIZE, [editor('a'), editor('b')]);

interface Leaf {
  type: string;
  size: number;
  data: Leaf[] & { id: string; views: string[]; activeView?: string };
}
const groups = (dock: SerializedDockview) => {
  const found: [string, string[]][] = [];
  const visit = (node: Leaf) => {
    if (node.type === 'leaf') found.push([node.data.id, node.data.views]);
    else node.data.forEach(visit);
  };
  visit(dock.grid.root as unknown as Leaf);
  return found;
};
const restore = (dock: SerializedDockview, alive: string[], size = SIZE) =>
  restoreLayout(
    { version: 1, dock },
    { panelExists: (id) => PANELS.some((one) => one.id === id), objectExists: (id) => alive.includes(id), size },
  )!;

describe('the default layout', () => {
  it('has trees left, editors in the middle, lists below over the whole width', () => {
    expect(groups(layout())).toEqual([
      ['left', ['devices', 'pous']],
      ['editors', ['editor:a', 'editor:b']],
      ['bottom', ['messages']],
    ]);
  });

  it('fills the size it is given', () => {
    const root = layout().grid.root as unknown as Leaf;
    const [upper, bottom] = root.data;
    expect(upper!.size + bottom!.size).toBe(SIZE.height);
    expect(upper!.data.reduce((sum, leaf) => sum + leaf.size, 0)).toBe(SIZE.width);
  });

  it('keeps an editor area without editors', () => {
    expect(groups(defaultLayout(PANELS, (one) => one.id, SIZE))).toContainEqual(['editors', []]);
  });
});

describe('a stored layout', () => {
  it('comes back without what is gone', () => {
    const dock = layout();
    dock.panels.watch9 = { id: 'watch9', contentComponent: 'tool' };
    const back = restore(dock, ['b']);
    expect(groups(back)).toContainEqual(['editors', ['editor:b']]);
    expect(Object.keys(back.panels).sort()).toEqual(['devices', 'editor:b', 'messages', 'pous']);
  });

  it('keeps the editor area when its last object is gone', () => {
    expect(groups(restore(layout(), []))).toContainEqual(['editors', []]);
  });

  it('forgets where an editor was to jump to', () => {
    const dock = layout();
    dock.panels['editor:a']!.params!.reveal = { serial: 1, focus: true };
    expect(restore(dock, ['a', 'b']).panels['editor:a']!.params!.reveal).toBeNull();
  });

  it('brings windows back as floating groups, and drops empty ones', () => {
    const dock = layout();
    dock.panels.doc = { id: 'doc', contentComponent: 'tool' };
    dock.popoutGroups = [
      { data: { id: 'w', views: ['doc'] }, position: { left: 5, top: 5, width: 9, height: 9 } },
      { data: { id: 'x', views: ['editor:gone'] }, position: null },
    ];
    dock.panels['editor:gone'] = { id: 'editor:gone', contentComponent: 'editor', params: { objectId: 'gone' } };
    const back = restore(dock, ['a', 'b']);
    expect(back.popoutGroups).toBeUndefined();
    expect(back.floatingGroups!.map((group) => group.data!.views)).toEqual([['doc']]);
  });

  it('keeps the docks as large as they were in another window', () => {
    const root = restore(layout(), ['a', 'b'], { width: 2500, height: 1300 }).grid.root as unknown as Leaf;
    const [upper, bottom] = root.data;
    expect([upper!.size, bottom!.size]).toEqual([1080, 220]);
    expect(upper!.data.map((leaf) => leaf.size)).toEqual([280, 2220]);
  });

  it('leaves room for the editors in a small window', () => {
    const root = restore(layout(), ['a', 'b'], { width: 300, height: 200 }).grid.root as unknown as Leaf;
    expect(root.data[0]!.size).toBe(60);
    expect(root.data[0]!.data.map((leaf) => leaf.size)).toEqual([210, 90]);
  });

  it('of another version or shape is refused', () => {
    for (const blob of [
      null,
      5,
      {},
      { version: 2, dock: layout() },
      { version: 1, dock: { grid: null } },
      { version: 1 },
    ]) {
      expect(restoreLayout(blob, { panelExists: () => true, objectExists: () => true, size: SIZE })).toBeNull();
    }
  });
});
