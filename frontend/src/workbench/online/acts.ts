/** What the online commands do: build, find the runtime, log in by relation, download, start, stop, reset. */
import { api, isCancelled } from '@/api/client';
import { shaped } from '@/api/objects';
import { keys, objectQuery, queryClient, runtimesQuery } from '@/api/queries';
import type { BuildReport, LoginAnswer, ObjectSummary, RuntimeState } from '@/api/types';
import { language, t } from '@/i18n';
import { saveObject } from '@/api/queries';
import { commandContext, type CommandContext } from '../context';
import { saveEditors } from '../docking/close';
import { showPanel } from '../docking/dock';
import { saveBlob } from '../downloadFile';
import { buildFinished, bytesText, clearMessages } from '../messages/store';
import { confirm } from '@/ui/dialogs';
import { notify } from '@/ui/notices';
import { loggedIn, loggedOut, relationChanged, runtimePolled } from '../onlineSession';
import { ofRole } from '@/project/kinds';
import { useProject } from '@/project/openProject';
import { atLeast } from '../rights';
import { askDownload, askLogin, askLoginWithErrors, askRuntime } from './dialogs';
import { relationKnown } from './knownRelation';
import { LOCAL_RUNTIME } from './offlineTarget';
import { compareLogin } from './relation';
import { sourceWanted, tellSourceProblem } from './source';

/** Runs a long act with its name in the status bar; one at a time. */
async function busy<Answer>(text: string, act: (signal: AbortSignal) => Promise<Answer>): Promise<Answer> {
  const abort = new AbortController();
  useProject.setState({ busy: { text, cancel: () => abort.abort() } });
  try {
    return await act(abort.signal);
  } finally {
    useProject.setState({ busy: null });
  }
}

function nameOf(context: CommandContext): string {
  const objects = queryClient.getQueryData<ObjectSummary[]>(keys.objects(context.projectId!)) ?? [];
  return objects.find((object) => object.id === context.applicationId)?.name ?? '';
}

/** Builds and says how large the code is that a download would bring into the controller. */
export async function generateCode(context: CommandContext): Promise<void> {
  const report = await build(context);
  if (!report?.ok) return;
  const sizes = { code: bytesText(report.code_size ?? 0), data: bytesText(report.data_size ?? 0) };
  notify({ tone: 'ok', title: t('build.generated', { name: nameOf(context) }), text: t('build.sizes', sizes) });
}

/** Forgets what builds and downloads of the active application, or of all of them, have left; asks before. */
export async function clean(context: CommandContext, all: boolean): Promise<void> {
  const name = all ? useProject.getState().projectName : nameOf(context);
  const sure = await confirm({
    title: t(all ? 'clean.all.title' : 'clean.title', { name }),
    text: t('clean.text'),
    action: t('clean.action'),
    danger: true,
  });
  if (!sure) return;
  const { project_id, application_id } = applicationPath(context);
  if (all) await api.post('/api/v1/projects/{project_id}/clean', { params: { path: { project_id } } });
  else {
    const params = { path: { project_id, application_id } };
    await api.post('/api/v1/projects/{project_id}/applications/{application_id}/clean', { params });
  }
  clearMessages();
  notify({ tone: 'ok', title: t('clean.done', { name }) });
}

/**
 * Logged in, the application of the controller becomes the one that it starts with; else the application comes as the
 * file that a controller starts with.
 */
export async function createBootApplication(context: CommandContext): Promise<void> {
  const name = nameOf(context);
  if (context.online) {
    const { runtimeId } = context.online;
    runtimePolled(runtimeId, await api.post('/api/v1/runtimes/{runtime_id}/boot-application', runtimeAt(runtimeId)));
    notify({ tone: 'ok', title: t('boot.created', { name }), text: t('boot.createdText') });
    return;
  }
  const report = await build(context);
  if (!report) return;
  if (!report.ok) {
    tellBuildErrors();
    return;
  }
  const blob = await api.download('/api/v1/projects/{project_id}/applications/{application_id}/boot-application', {
    params: { path: applicationPath(context) },
  });
  saveBlob(blob, BOOT_FILE);
  notify({ tone: 'ok', title: t('boot.saved', { name }), text: t('boot.savedText', { file: BOOT_FILE }) });
}

/** The name under which a controller looks for it in its data folder. */
const BOOT_FILE = 'boot.tappet';

/** The names that questions about the active application give. */
function namesOf(context: CommandContext): { application: string; project: string } {
  return { application: nameOf(context), project: useProject.getState().projectName };
}

/** Place of the active application in requests. */
function applicationPath({ projectId, applicationId }: CommandContext) {
  return { project_id: projectId!, application_id: applicationId! };
}

function inLanguage(context: CommandContext, signal?: AbortSignal) {
  return { params: { path: applicationPath(context), query: { language: language() } }, signal };
}

const BUILDS = {
  build: '/api/v1/projects/{project_id}/applications/{application_id}/build',
  rebuild: '/api/v1/projects/{project_id}/applications/{application_id}/rebuild',
} as const;

/**
 * Saves what is open and builds the active application; a rebuild uses nothing of earlier builds. Null when it was
 * cancelled or something could not be saved.
 */
export async function build(context: CommandContext, how: keyof typeof BUILDS = 'build'): Promise<BuildReport | null> {
  const { applicationId } = context;
  if (!(await saveEditors(context.dirtyPanels))) return null;
  const applicationName = nameOf(context);
  try {
    const report = await busy(t('busy.build', { name: applicationName }), (signal) =>
      api.post(BUILDS[how], inLanguage(context, signal)),
    );
    const again = () => api.post(BUILDS.build, inLanguage(context));
    buildFinished({ applicationId: applicationId!, applicationName, report, at: Date.now(), again });
    if (!report.ok) showPanel('messages', false);
    if (report.ok && context.online) await refreshRelation(context);
    return report;
  } catch (error) {
    if (isCancelled(error)) return null;
    throw error;
  }
}

/** Checks the active application with all coding rules it has chosen. Null when it was cancelled. */
export async function analyse(context: CommandContext): Promise<BuildReport | null> {
  const { applicationId } = context;
  if (!(await saveEditors(context.dirtyPanels))) return null;
  const applicationName = nameOf(context);
  try {
    const ask = (signal?: AbortSignal) =>
      api.post(
        '/api/v1/projects/{project_id}/applications/{application_id}/static-analysis',
        inLanguage(context, signal),
      );
    const report = await busy(t('busy.analysis', { name: applicationName }), ask);
    buildFinished({ applicationId: applicationId!, applicationName, report, at: Date.now(), again: () => ask() });
    showPanel('messages', false);
    return report;
  } catch (error) {
    if (isCancelled(error)) return null;
    throw error;
  }
}

/** While logged in: how the runtime's application relates to the one just built. */
async function refreshRelation(context: CommandContext): Promise<void> {
  const answer = await compare(context, context.online!.runtimeId);
  relationChanged(context.applicationId!, answer.relation);
}

function compare(context: CommandContext, runtimeId: string): Promise<LoginAnswer> {
  return compareLogin(context.projectId!, context.applicationId!, runtimeId);
}

/** The runtime that the active application's device leads to; asks when none has been chosen. Null when cancelled. */
async function findRuntime(context: CommandContext): Promise<RuntimeState | null> {
  const stored = await queryClient.ensureQueryData(objectQuery(context.projectId!, context.deviceId!));
  const device = shaped(stored, ofRole('device'));
  const runtimes = await queryClient.fetchQuery({ ...runtimesQuery, staleTime: 0 });
  const wanted = device.data.simulated ? LOCAL_RUNTIME : device.data.runtime_id;
  const found = runtimes.find((runtime) => runtime.id === wanted);
  if (found) return found;
  const chosen = runtimes.length === 1 && wanted === null ? runtimes[0]! : await askRuntime(runtimes, wanted);
  if (!chosen) return null;
  if (!device.data.simulated && atLeast(context.role, 'engineer')) {
    await saveObject(context.projectId!, device.id, device.revision, { ...device.data, runtime_id: chosen.id });
  }
  return chosen;
}

/** Login as CODESYS does it: build, compare with what the runtime holds, ask what to do about a difference. */
export async function login(context: CommandContext): Promise<void> {
  // Before anything is asked: which runtime it is may be what has just been changed.
  if (!(await saveEditors(context.dirtyPanels))) return;
  const runtime = await findRuntime(context);
  if (!runtime) return;
  if (!runtime.connected)
    throw new Error(t('login.notConnected', { name: runtime.name, problem: runtime.problem ?? '' }).trim());
  const mayLoad = atLeast(context.role, 'engineer');
  if (mayLoad) {
    const report = await build(context);
    if (!report) return;
    if (!report.ok) return loginWithErrors(context, runtime);
  }
  const answer = await compare(context, runtime.id);
  if (answer.relation === 'same') {
    loggedIn(context.applicationId!, runtime.id, 'same');
    runtimePolled(runtime.id, runtime);
    return;
  }
  if (!mayLoad && (answer.relation === 'foreign' || answer.relation === 'empty'))
    throw new Error(t('login.engineerLoads'));
  const choice = await askLogin({ answer, ...namesOf(context), runtime, mayLoad });
  if (!choice) return;
  if (choice.how === 'without') {
    loggedIn(context.applicationId!, runtime.id, answer.relation);
    runtimePolled(runtime.id, runtime);
    return;
  }
  await load(context, runtime.id, choice.how, choice.start, choice.fresh);
}

/** What does not build cannot be loaded: its last loaded state may still be looked at. */
async function loginWithErrors(context: CommandContext, runtime: RuntimeState): Promise<void> {
  const { relation } = await compare(context, runtime.id);
  const { application, project } = namesOf(context);
  // Foreign values would stand behind names that only happen to be the same.
  if (relation === 'foreign' || relation === 'empty') tellBuildErrors();
  else if (await askLoginWithErrors(application, project, runtime.name)) {
    loggedIn(context.applicationId!, runtime.id, relation);
    runtimePolled(runtime.id, runtime);
  }
}

function tellBuildErrors(): void {
  notify({ tone: 'error', title: t('login.buildErrors'), text: t('login.buildErrorsText') });
}

const NOTHING_TO_LOAD: LoginAnswer = {
  relation: 'same',
  reasons: [],
  changes: [],
  changes_omitted: 0,
  reserve: null,
  loaded_project: null,
  persistent: [],
  retain_layout_changes: false,
};

/** Brings the built application into the runtime and shows its values from then on. */
async function load(
  context: CommandContext,
  runtimeId: string,
  mode: 'download' | 'online_change',
  start: boolean,
  fresh = false,
): Promise<void> {
  const name = nameOf(context);
  const source = await sourceWanted(context);
  const done = await busy(t(mode === 'download' ? 'busy.download' : 'busy.onlineChange', { name }), () =>
    api.post('/api/v1/projects/{project_id}/applications/{application_id}/download', {
      params: { path: applicationPath(context) },
      body: { runtime_id: runtimeId, mode, start, source, initialise_persistent: fresh },
    }),
  );
  relationKnown(context.applicationId!, runtimeId, NOTHING_TO_LOAD);
  if (commandContext().online?.runtimeId === runtimeId) relationChanged(context.applicationId!, 'same');
  else loggedIn(context.applicationId!, runtimeId, 'same');
  runtimePolled(runtimeId, await api.get('/api/v1/runtimes/{runtime_id}', runtimeAt(runtimeId)));
  notify({ tone: 'ok', title: t(mode === 'download' ? 'login.downloaded' : 'login.changed', { name }) });
  tellSourceProblem(done.source_problem);
}

/** Ends showing values; the controller keeps running. */
export async function logout(context: CommandContext): Promise<void> {
  loggedOut(context.applicationId!);
  await api.post('/api/v1/projects/{project_id}/applications/{application_id}/logout', {
    params: { path: applicationPath(context) },
  });
}

/** Download while logged in: builds and asks before it stops the machine. */
export async function download(context: CommandContext): Promise<void> {
  const report = await build(context);
  if (!report) return;
  if (!report.ok) {
    tellBuildErrors();
    return;
  }
  const session = context.online!;
  const { persistent } = await compare(context, session.runtimeId);
  const running = session.runtime?.state === 'run';
  const choice = await askDownload({ ...namesOf(context), running, persistent });
  if (choice) await load(context, session.runtimeId, 'download', choice.start, choice.fresh);
}

/**
 * Online change while logged in: the machine keeps running and its variables keep their values. With `ask` the dialog
 * of the login offers it together with what else is possible.
 */
export async function onlineChange(context: CommandContext, ask = false): Promise<void> {
  const report = await build(context);
  const session = context.online!;
  if (!report?.ok || session.runtime === null) return;
  const answer = await compare(context, session.runtimeId);
  if (answer.relation === 'same') notify({ tone: 'info', title: t('reason.nothingChanged') });
  else if (answer.relation === 'online_change' && !ask) await load(context, session.runtimeId, 'online_change', false);
  else {
    // Where only a download can load this change, the dialog says what stands in the way.
    const question = { answer, ...namesOf(context), runtime: session.runtime, mayLoad: true };
    const choice = await askLogin(question);
    if (choice && choice.how !== 'without')
      await load(context, session.runtimeId, choice.how, choice.start, choice.fresh);
  }
}

const ACTS = {
  start: '/api/v1/runtimes/{runtime_id}/start',
  stop: '/api/v1/runtimes/{runtime_id}/stop',
  'single-cycle': '/api/v1/runtimes/{runtime_id}/single-cycle',
} as const;

function runtimeAt(runtimeId: string) {
  return { params: { path: { runtime_id: runtimeId } } };
}

export async function runtimeAct(context: CommandContext, act: keyof typeof ACTS): Promise<void> {
  const runtimeId = context.online!.runtimeId;
  runtimePolled(runtimeId, await api.post(ACTS[act], runtimeAt(runtimeId)));
}

export async function reset(context: CommandContext, kind: 'warm' | 'cold' | 'origin'): Promise<void> {
  const runtimeId = context.online!.runtimeId;
  const order = { ...runtimeAt(runtimeId), body: { kind } };
  runtimePolled(runtimeId, await api.post('/api/v1/runtimes/{runtime_id}/reset', order));
  // Reset origin unloads the application: there is nothing left to be logged in to.
  if (kind === 'origin') loggedOut(context.applicationId!);
}
