import {
  DockviewReact,
  type DockviewApi,
  type DockviewReadyEvent,
  type DockviewTheme,
  type SerializedDockview,
} from 'dockview-react';
import 'dockview-react/dist/styles/dockview.css';
import { useEffect, useMemo, useState } from 'react';
import { usePreferences } from '@/session/preferences';
import { saveSettingLater, saveSettingNow } from '@/session/settingsLater';
import { notifyError } from '@/ui/notices';
import { useSelection } from '../selection';
import { resetLayout, setDockApi } from './dock';
import './dockview.css';
import { EditorPanel } from './EditorPanel';
import { keepDockSizes } from './docks';
import { followEditors, panelAround, pruneEmptyGroups } from './follow';
import type { StoredLayout } from './layout';
import { EditorTab, ToolTab } from './Tab';
import { ToolPanel } from './ToolPanel';
import { Watermark } from './Watermark';

const COMPONENTS = { editor: EditorPanel, tool: ToolPanel };
const TABS = { editor: EditorTab, tool: ToolTab };
const SAVE_AFTER_MS = 1200;

interface DockAreaProps {
  projectId: string;
  /** Layout of the last visit, fit for use; null starts with the default one. */
  layout: SerializedDockview | null;
}

/** The docking area between tool bar and status bar. Layout changes are stored per user and project. */
export function DockArea({ projectId, layout }: DockAreaProps) {
  const shown = usePreferences((state) => state.shown);
  const theme = useMemo<DockviewTheme>(
    () => ({
      name: 'tappet',
      className: 'dockview-theme-tappet',
      colorScheme: shown,
      dndTabIndicator: 'line',
      dndPanelOverlay: 'group',
      tabGroupIndicator: 'none',
    }),
    [shown],
  );
  const [api, setApi] = useState<DockviewApi | null>(null);

  const onReady = ({ api: ready }: DockviewReadyEvent) => {
    setDockApi(ready);
    start(ready, layout);
    setApi(ready);
  };

  useEffect(() => {
    if (!api) return;
    setDockApi(api);
    const disposers = [followEditors(api), keepDockSizes(api), saveLayout(api, projectId), followFocus()];
    return () => {
      disposers.forEach((dispose) => dispose());
      setDockApi(null);
    };
  }, [api, projectId]);

  return (
    <DockviewReact
      components={COMPONENTS}
      tabComponents={TABS}
      watermarkComponent={Watermark}
      onReady={onReady}
      theme={theme}
      closeEmptyGroups={false}
      noPanelsOverlay="emptyGroup"
      floatingGroupBounds="boundedWithinViewport"
      scrollbars="native"
      announcements={false}
    />
  );
}

function start(api: DockviewApi, layout: SerializedDockview | null): void {
  if (layout) {
    try {
      api.fromJSON(layout);
      pruneEmptyGroups(api);
      return;
    } catch {
      // A layout of an older version that dockview no longer reads: begin with the default one.
      api.clear();
    }
  }
  resetLayout();
}

/** Stores the layout a moment after the last change, and when the project is left. */
function saveLayout(api: DockviewApi, projectId: string): () => void {
  const key = `layout.${projectId}`;
  const stored = (): StoredLayout => ({ version: 1, dock: api.toJSON() });
  const listener = api.onDidLayoutChange(() => saveSettingLater(key, stored, SAVE_AFTER_MS, notifyError));
  return () => {
    listener.dispose();
    saveSettingNow(key);
  };
}

/** Remembers which panel holds the keyboard focus or was clicked last: commands go to its handlers. */
function followFocus(): () => void {
  const follow = (event: Event) => {
    const focusedPanel = panelAround(event.target);
    if (focusedPanel && focusedPanel !== useSelection.getState().focusedPanel) useSelection.setState({ focusedPanel });
  };
  document.addEventListener('focusin', follow);
  document.addEventListener('pointerdown', follow, true);
  return () => {
    document.removeEventListener('focusin', follow);
    document.removeEventListener('pointerdown', follow, true);
  };
}
