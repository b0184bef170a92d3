/** The search of this window: the form, the results, and the acts on them. */
import { create } from 'zustand';
import { api, ApiError, isCancelled } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import { t } from '@/i18n';
import { useProject } from '@/project/openProject';
import { guard, notify, notifyError } from '@/ui/notices';
import { saveEditors } from '@/workbench/docking/close';
import { useSelection } from '@/workbench/selection';
import {
  AREAS,
  fieldOfProblem,
  joined,
  orderOf,
  replaceOrderOf,
  type ScopeObjects,
  type SearchForm,
  type SearchObject,
} from './model';

interface SearchState {
  form: SearchForm;
  projectId: string | null;
  groups: readonly SearchObject[];
  /** The object behind which the search can go on. */
  next: string | null;
  /** What was asked last has been answered. */
  answered: boolean;
  busy: boolean;
  error: { field: 'text' | 'replacement' | null; text: string } | null;
  leftOut: ReadonlySet<string>;
  /** Grows with each wish to type into the form. */
  focusSerial: number;
}

const NOTHING = {
  groups: [],
  next: null,
  answered: false,
  busy: false,
  error: null,
  leftOut: new Set<string>(),
} satisfies Partial<SearchState>;

export const useSearch = create<SearchState>(() => ({
  form: {
    text: '',
    replacement: '',
    replacing: false,
    matchCase: false,
    wholeWords: false,
    regularExpression: false,
    areas: AREAS,
    scope: 'project',
  },
  projectId: null,
  ...NOTHING,
  focusSerial: 0,
}));

const PAUSE_MS = 250;
let timer: ReturnType<typeof setTimeout> | undefined;
let running: AbortController | null = null;

export function scopeObjects(): ScopeObjects {
  const { objectIds, editors } = useSelection.getState();
  return {
    applicationId: useProject.getState().applicationId,
    selection: objectIds,
    editors: [...new Set(editors.map((editor) => editor.objectId))],
  };
}

/** The form has other values: the search begins anew when the typing pauses. */
export function changeForm(change: Partial<SearchForm>): void {
  useSearch.setState(({ form }) => ({ form: { ...form, ...change } }));
  clearTimeout(timer);
  timer = setTimeout(() => void search(), PAUSE_MS);
}

/** Begins the search anew, now. */
export async function search(): Promise<void> {
  clearTimeout(timer);
  running?.abort();
  running = null;
  const { projectId } = useProject.getState();
  if (projectId === null) return;
  // What is typed and not yet stored shall be found, too.
  await saveEditors([...useSelection.getState().dirty]);
  useSearch.setState({ projectId });
  await ask(null);
}

/** The next part of results that were too many for one answer. */
export function searchOn(): Promise<void> {
  const { next } = useSearch.getState();
  return next === null ? Promise.resolve() : ask(next);
}

async function ask(after: string | null): Promise<void> {
  const { form, projectId } = useSearch.getState();
  const order = orderOf(form, scopeObjects(), after);
  if (projectId === null || order === null) {
    useSearch.setState(NOTHING);
    return;
  }
  const mine = new AbortController();
  running = mine;
  useSearch.setState({ busy: true });
  try {
    const report = await api.post('/api/v1/projects/{project_id}/search', {
      params: { path: { project_id: projectId } },
      body: order,
      signal: mine.signal,
    });
    useSearch.setState((state) => ({
      ...NOTHING,
      answered: true,
      groups: after === null ? report.objects : joined(state.groups, report.objects),
      leftOut: after === null ? NOTHING.leftOut : state.leftOut,
      next: report.next,
    }));
  } catch (error) {
    if (isCancelled(error)) return;
    const field = error instanceof ApiError ? fieldOfProblem(error.problem.type) : null;
    useSearch.setState({ ...NOTHING, error: { field, text: error instanceof Error ? error.message : String(error) } });
  } finally {
    if (running === mine) running = null;
  }
}

export function stopSearch(): void {
  running?.abort();
  useSearch.setState({ busy: false });
}

export function clearSearch(): void {
  stopSearch();
  useSearch.setState(({ form }) => ({ ...NOTHING, form: { ...form, text: '', replacement: '' } }));
}

/** Replaces what is chosen as one change of the project, which a notice offers to take back. */
export async function replaceChosen(): Promise<void> {
  const { form, groups, leftOut, projectId } = useSearch.getState();
  const order = replaceOrderOf(form, groups, leftOut);
  if (projectId === null || order === null) return;
  const params = { path: { project_id: projectId } };
  try {
    const report = await api.post('/api/v1/projects/{project_id}/replace', { params, body: order });
    refreshObjects(projectId);
    await search();
    const { revision } = report;
    notify({
      tone: 'ok',
      title: t('search.replaced', { count: report.hits }),
      text: t('search.replacedIn', { count: report.objects }),
      action:
        revision === null
          ? undefined
          : { text: t('command.undo'), run: () => void guard(() => takeBack(projectId, revision)) },
    });
  } catch (error) {
    const stale = error instanceof ApiError && error.status === 409;
    if (stale) {
      notify({ tone: 'warn', title: t('search.stale'), text: error.message });
      await search();
    } else if (error instanceof ApiError && fieldOfProblem(error.problem.type) !== null) {
      useSearch.setState({ error: { field: fieldOfProblem(error.problem.type), text: error.message } });
    } else notifyError(error);
  }
}

async function takeBack(projectId: string, revision: number): Promise<void> {
  await api.post('/api/v1/projects/{project_id}/revisions/{revision}/undo', {
    params: { path: { project_id: projectId, revision } },
  });
  refreshObjects(projectId);
  await search();
}

/** The events socket tells of changes, too; who has made one sees it at once. */
function refreshObjects(projectId: string): void {
  void queryClient.invalidateQueries({ queryKey: keys.project(projectId) });
}
