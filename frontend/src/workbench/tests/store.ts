/** The last test run of an application, which the server keeps, and running one. */
import { create } from 'zustand';
import { api } from '@/api/client';
import { queryClient, testRunQuery } from '@/api/queries';
import type { TestReport } from '@/api/types';
import { t } from '@/i18n';
import type { CommandContext } from '../context';
import { saveEditors } from '../docking/close';
import { showPanel } from '../docking/dock';
import { buildFinished } from '../messages/store';
import { useProject } from '@/project/openProject';
import { namesOfBad } from './model';

export const useTests = create<{ filter: string }>(() => ({ filter: '' }));

export function setFilter(filter: string): void {
  useTests.setState({ filter });
}

/** Saves what is open and runs the tests of the active application; the results panel shows what came of it. */
export function runTests(context: CommandContext): Promise<void> {
  return run(context, []);
}

/** Runs the tests again that were not good; the others keep their results. */
export function runFailedTests(context: CommandContext): Promise<void> {
  return run(context, namesOfFailed(context));
}

/** The tests of the active application that were not good in its last run. */
export function namesOfFailed({ projectId, applicationId }: CommandContext): readonly string[] {
  const last = projectId && applicationId && queryClient.getQueryData(testRunQuery(projectId, applicationId).queryKey);
  return last ? namesOfBad(last.report) : [];
}

async function run(context: CommandContext, only: readonly string[]): Promise<void> {
  const { projectId, applicationId } = context;
  if (!projectId || !applicationId || !(await saveEditors(context.dirtyPanels))) return;
  showPanel('tests', false);
  const path = '/api/v1/projects/{project_id}/applications/{application_id}/tests';
  const params = { path: { project_id: projectId, application_id: applicationId } };
  const cancel = () => void api.delete(path, { params }).catch(() => undefined); // it may have ended by itself
  useProject.setState({ busy: { text: t('tests.running'), cancel } });
  const begun = performance.now();
  try {
    const filter = only.length > 0 ? '' : useTests.getState().filter;
    const report = await api.post(path, { params, body: { filter, only: [...only] } });
    await queryClient.fetchQuery({ ...testRunQuery(projectId, applicationId), staleTime: 0 });
    if (report.diagnostics.length > 0) showErrors(applicationId, report, (performance.now() - begun) / 1000);
  } finally {
    useProject.setState({ busy: null });
  }
}

/** Errors of the program stand where those of a build stand. */
function showErrors(applicationId: string, report: TestReport, seconds: number): void {
  const failed = { ok: false, diagnostics: report.diagnostics, code_id: null, data_id: null };
  const build = { ...failed, code_size: null, data_size: null, seconds };
  buildFinished({ applicationId, applicationName: t('tests.title'), report: build, at: Date.now() });
  showPanel('messages', false);
}
