/** Keeps the stores in step with dockview: which editors are open, which is active, and that an editor area remains. */
import type { DockviewApi } from 'dockview-react';
import { setCursor, setDirty, useSelection } from '../selection';
import { editorGroupUsed } from './dock';
import { dockOf, isEditor, withDockSizes } from './docks';
import { EDITORS_GROUP, type EditorParams } from './layout';

/** Id of the dock panel that an element is in. */
export function panelAround(element: EventTarget | null): string | undefined {
  return element instanceof Element ? element.closest<HTMLElement>('[data-panel-id]')?.dataset.panelId : undefined;
}

export function followEditors(api: DockviewApi): () => void {
  const list = () => {
    const editors = api.panels.filter(isEditor).map((panel) => {
      const { objectId, instance } = panel.params as EditorParams;
      return { panelId: panel.id, objectId, instance };
    });
    const { activeEditor } = useSelection.getState();
    const active = editors.some((editor) => editor.panelId === activeEditor)
      ? activeEditor
      : (editors.at(-1)?.panelId ?? null);
    useSelection.setState({ editors, activeEditor: active });
  };
  const activate = () => {
    const panel = api.activePanel;
    if (!panel) return;
    // Where the keyboard is counts more than which tab is in front.
    const focusedPanel = panelAround(document.activeElement) ?? panel.id;
    useSelection.setState(isEditor(panel) ? { activeEditor: panel.id, focusedPanel } : { focusedPanel });
    if (isEditor(panel)) editorGroupUsed(panel.group.id);
    requestAnimationFrame(() => showTab(panel.id));
  };
  const disposers = [
    api.onDidAddPanel(list),
    api.onDidLayoutFromJSON(list),
    api.onDidActivePanelChange(activate),
    api.onDidMovePanel(() => queueMicrotask(() => pruneEmptyGroups(api))),
    api.onDidRemovePanel((panel) => {
      setDirty(panel.id, false);
      setCursor(panel.id, null);
      queueMicrotask(() => {
        pruneEmptyGroups(api);
        list();
      });
    }),
  ];
  list();
  activate();
  return () => {
    disposers.forEach((disposer) => disposer.dispose());
    useSelection.setState({ editors: [], activeEditor: null, focusedPanel: null });
  };
}

/** With many tabs the one in front may be out of sight or half of it. */
function showTab(panelId: string): void {
  const tab = document.querySelector(`[data-tab-panel-id="${CSS.escape(panelId)}"]`);
  tab?.scrollIntoView({ block: 'nearest', inline: 'nearest' });
}

/** Empty groups go, but for one: the editor area stays in its place when its last tab is closed. */
export function pruneEmptyGroups(api: DockviewApi): void {
  const inGrid = api.groups.filter((group) => group.api.location.type === 'grid');
  const empty = api.groups.filter((group) => group.panels.length === 0);
  const hasEditors = inGrid.some((group) => group.panels.some(isEditor));
  const emptyInGrid = inGrid.filter((group) => group.panels.length === 0);
  const kept = hasEditors ? undefined : (emptyInGrid.find((group) => group.id === EDITORS_GROUP) ?? emptyInGrid[0]);
  const gone = empty.filter((group) => group !== kept);
  if (gone.length > 0) withDockSizes(api, () => gone.forEach((group) => api.removeGroup(group)));
  if (!hasEditors && !kept) {
    const left = api.groups.find((group) => dockOf(group) === 'left');
    api.addGroup(left ? { referenceGroup: left, direction: 'right' } : { direction: 'right' });
  }
}
