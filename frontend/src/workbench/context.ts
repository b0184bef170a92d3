/**
 * What commands look at to know whether they may run: one plain snapshot of the stores.
 *
 * `commandContext()` builds it now; components that show commands use `useCommandContext()`, which follows every store
 * that the snapshot is made of.
 */
import { keys, queryClient, useObjects } from '@/api/queries';
import type { DeviceData, ObjectSummary, ProjectObject, Role } from '@/api/types';
import { useSession } from '@/app/session';
import { useRegistry } from './commands';
import { useOnline, type OnlineSession } from './onlineSession';
import { useProject } from './project';
import { useSelection } from './selection';
import { ancestorOfKind } from './tree/model';

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
  const device = ancestorOfKind(objects, applicationId, 'device');
  const deviceData =
    projectId && device && queryClient.getQueryData<ProjectObject<DeviceData>>(keys.object(projectId, device.id));
  const chosen = new Set(selection.objectIds);
  return {
    role: useSession.getState().user?.role ?? null,
    projectId,
    applicationId,
    deviceId: device?.id ?? null,
    runtimeId: deviceData ? deviceData.data.runtime_id : null,
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

/** The context for components: draws again when anything in it may have changed. */
export function useCommandContext(): CommandContext {
  useSession();
  const { projectId } = useProject();
  useSelection();
  useOnline();
  useRegistry((state) => state.version);
  useObjects(projectId);
  return commandContext();
}
