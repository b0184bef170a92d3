/**
 * What commands look at to know whether they may run: one plain snapshot of the stores.
 *
 * `commandContext()` builds it now; components that show commands use `useCommandContext()`.
 */
import { keys, objectQuery, queryClient } from '@/api/queries';
import type { ObjectSummary, Role } from '@/api/types';
import { useSession } from '@/session/session';
import { useOnline, type OnlineSession } from './onlineSession';
import { useProject } from '@/project/openProject';
import { useSelection } from './selection';
import { ofRole } from '@/project/kinds';
import { deviceOf } from '@/project/tree';

export interface ActiveEditor {
  panelId: string;
  objectId: string;
  kind: string;
  dirty: boolean;
}

export interface CommandContext {
  /** Role of the signed-in user; null before login. */
  role: Role | null;
  projectId: string | null;
  /** The active application (choice in the tool bar). */
  applicationId: string | null;
  /** Device that carries the active application. */
  deviceId: string | null;
  /** Runtime chosen in that device, null when none is. */
  runtimeId: string | null;
  /** Objects selected in the tree that had the focus last. */
  selection: readonly ObjectSummary[];
  activeEditor: ActiveEditor | null;
  /** Panels with unsaved changes. */
  dirtyPanels: readonly string[];
  /** Dock panel that holds the keyboard focus. */
  focusedPanel: string | null;
  /** Login of the active application; null while logged out. */
  online: OnlineSession | null;
  /** A build, login or download is under way. */
  busy: boolean;
}

const NO_OBJECTS: readonly ObjectSummary[] = [];

export function commandContext(): CommandContext {
  const { projectId, applicationId, busy } = useProject.getState();
  const objects = (projectId && queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId))) || NO_OBJECTS;
  const selection = useSelection.getState();
  const editor = selection.editors.find((entry) => entry.panelId === selection.activeEditor);
  const device = deviceOf(objects, applicationId);
  const stored = projectId && device && queryClient.getQueryData(objectQuery(projectId, device.id).queryKey);
  const chosen = new Set(selection.objectIds);
  return {
    role: useSession.getState().user?.role ?? null,
    projectId,
    applicationId,
    deviceId: device?.id ?? null,
    runtimeId: stored && ofRole('device')(stored) ? stored.data.runtime_id : null,
    selection: chosen.size ? objects.filter((object) => chosen.has(object.id)) : NO_OBJECTS,
    activeEditor: editor
      ? {
          panelId: editor.panelId,
          objectId: editor.objectId,
          kind: objects.find((object) => object.id === editor.objectId)?.kind ?? '',
          dirty: selection.dirty.has(editor.panelId),
        }
      : null,
    dirtyPanels: [...selection.dirty],
    focusedPanel: selection.focusedPanel,
    online: (applicationId && useOnline.getState().sessions[applicationId]) || null,
    busy: busy !== null,
  };
}
