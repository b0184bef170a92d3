/** The docks around the editors: which group belongs to which, and that they keep their size. */
import type { DockviewApi, DockviewGroupPanel, IDockviewPanel } from 'dockview-react';
import { findPanel, type DockPosition } from '../panels';

export function isEditor(panel: IDockviewPanel): boolean {
  return panel.view.contentComponent === 'editor';
}

/** Which dock a group is: that of its first tool panel, when it holds tool panels only. */
export function dockOf(group: DockviewGroupPanel): DockPosition | undefined {
  const first = group.panels[0];
  if (!first || group.panels.some(isEditor) || group.api.location.type !== 'grid') return undefined;
  return findPanel(first.id)?.position;
}

/** Room that comes or goes is the editors' affair: after the act, trees and lists have the size they had before. */
export function withDockSizes(api: DockviewApi, act: () => void): void {
  const sizes = api.groups.map((group) => ({
    group,
    dock: dockOf(group),
    width: group.api.width,
    height: group.api.height,
  }));
  act();
  // Dockview lays out in the next frame; only then sizes can be set.
  requestAnimationFrame(() =>
    requestAnimationFrame(() => {
      for (const { group, dock, width, height } of sizes) {
        if (!dock || !api.groups.includes(group)) continue;
        group.api.setSize(dock === 'bottom' ? { height } : { width });
      }
    }),
  );
}

/** A wider window gives its room to the editors: trees and lists keep their size. */
export function keepDockSizes(api: DockviewApi): () => void {
  const onResize = () => withDockSizes(api, () => undefined);
  window.addEventListener('resize', onResize);
  return () => window.removeEventListener('resize', onResize);
}
