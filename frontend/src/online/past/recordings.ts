/** Recordings of the flight recorder: saved from a runtime into the project, and looked into in its place. */
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { t } from '@/i18n';
import { applicationOf } from '@/project/tree';
import { notify } from '@/ui/notices';
import { secondText } from '@/workbench/clock';
import { openObject } from '@/workbench/docking/dock';
import { loggedIn, loggedOut, runtimePolled, useOnline } from '@/workbench/onlineSession';
import { openTimeBar, timeBar } from './store';

/** Keeps what the flight recorder of a runtime holds as an object of the application, and opens it. */
export async function saveRecording(projectId: string, applicationId: string, runtimeId: string): Promise<void> {
  const name = t('past.savedName', { time: secondText(new Date().toISOString()).replaceAll(':', '-') });
  const made = await api.post('/api/v1/projects/{project_id}/applications/{application_id}/recordings', {
    params: { path: { project_id: projectId, application_id: applicationId } },
    body: { runtime_id: runtimeId, name },
  });
  await queryClient.invalidateQueries({ queryKey: keys.objects(projectId) });
  notify({ tone: 'ok', title: t('past.saved', { name: made.name }) });
  openObject(made.id, made.name);
}

/** Shows the values of a recording in all views: it takes the place of the controller that one is logged in to. */
export async function lookInto(projectId: string, objectId: string): Promise<void> {
  const { runtime, relation } = await api.post('/api/v1/projects/{project_id}/recordings/{object_id}/open', {
    params: { path: { project_id: projectId, object_id: objectId } },
  });
  const objects = queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId)) ?? [];
  const application = applicationOf(objects, objectId);
  if (!application) return;
  if (useOnline.getState().sessions[application.id]?.runtimeId !== runtime.id) {
    loggedOut(application.id);
    loggedIn(application.id, runtime.id, relation);
    runtimePolled(runtime.id, runtime);
  }
  const session = useOnline.getState().sessions[application.id];
  if (session && timeBar(runtime.id) === null) await openTimeBar(session);
}
