/** The last test run of the open project, and running one. */
import { create } from 'zustand';
import { api } from '@/api/client';
import type { TestReport } from '@/api/types';
import { t } from '@/i18n';
import type { CommandContext } from '../context';
import { saveEditors } from '../docking/close';
import { showPanel } from '../docking/dock';
import { buildFinished } from '../messages/store';
import { useProject } from '@/project/openProject';
import { namesOfBad, withOthers } from './model';

interface Run {
  projectId: string;
  applicationId: string;
  report: TestReport;
  seconds: number;
}

interface Tests {
  last: Run | null;
  filter: string;
}

export const useTests = create<Tests>(() => ({ last: null, filter: '' }));

export function setFilter(filter: string): void {
  useTests.setState({ filter });
}

/** Saves what is open and runs the tests of the active application; the results panel shows what came of it. */
export function runTests(context: CommandContext): Promise<void> {
  return run(context, []);
}

/** Runs the tests again that were not good; the others keep their results. */
export function runFailedTests(context: CommandContext): Promise<void> {
  const last = lastRunOf(context.projectId);
  return last ? run(context, namesOfBad(last.report)) : Promise.resolve();
}

/** The last run of a project. */
export function lastRunOf(projectId: string | null): Run | null {
  const { last } = useTests.getState();
  return last && last.projectId === projectId ? last : null;
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
    const before = lastRunOf(projectId)?.report;
    const filter = only.length > 0 ? '' : useTests.getState().filter;
    const now = await api.post(path, { params, body: { filter, only: [...only] } });
    const report = before && only.length > 0 ? withOthers(before, now, only) : now;
    const seconds = (performance.now() - begun) / 1000;
    useTests.setState({ last: { projectId, applicationId, report, seconds } });
    if (report.diagnostics.length > 0) showErrors(applicationId, report, seconds);
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
