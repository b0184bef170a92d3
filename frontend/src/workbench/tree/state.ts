/** What the trees remember: which objects are open, what is cut or copied, which one is being renamed. */
import { create } from 'zustand';
import { loadNames } from '@/session/preferences';
import { saveSettingLater } from '@/session/settingsLater';
import type { ObjectSummary } from '@/api/types';
import { kindOf } from '@/project/kinds';

interface TreeState {
  expanded: ReadonlySet<string>;
  /** Object whose name is being edited in the tree. */
  renaming: string | null;
  clipboard: { ids: readonly string[]; cut: boolean } | null;
  /** Asks the tree that holds the object to bring it into view and focus it. */
  reveal: { objectId: string; serial: number } | null;
}

export const useTree = create<TreeState>(() => ({
  expanded: new Set(),
  renaming: null,
  clipboard: null,
  reveal: null,
}));

const SAVE_AFTER_MS = 1500;

let project: string | null = null;
let serial = 0;

/** Reads which objects were open at the last visit; at the first one the device is open down to the tasks. */
export async function startTree(projectId: string, objects: readonly ObjectSummary[]): Promise<void> {
  const stored = await loadNames(`tree.${projectId}`).catch(() => null);
  const ids = stored ?? objects.filter((object) => kindOf(object.kind)?.tree?.openAtFirst).map((object) => object.id);
  project = projectId;
  useTree.setState({ expanded: new Set(ids), renaming: null, clipboard: null, reveal: null });
}

export function setExpanded(ids: readonly string[], expanded: boolean): void {
  const next = new Set(useTree.getState().expanded);
  for (const id of ids) {
    if (expanded) next.add(id);
    else next.delete(id);
  }
  useTree.setState({ expanded: next });
  saveSettingLater(`tree.${project}`, () => [...next], SAVE_AFTER_MS);
}

export function revealInTree(objectId: string): void {
  useTree.setState({ reveal: { objectId, serial: ++serial } });
}
