/** The results of unit tests and the command that runs them. */
import { FlaskConical, RotateCcw } from 'lucide-react';
import { lazy } from 'react';
import { registerCommands } from '../commands';
import { registerPanel } from '../panels';
import { allOf, atLeast } from '../rights';
import type { CommandContext } from '../context';
import { namesOfBad } from './model';
import { lastRunOf, runFailedTests, runTests } from './store';

const runnable = (context: CommandContext) =>
  allOf(
    !context.projectId ? 'reason.noProject' : context.applicationId ? true : 'reason.noApplication',
    atLeast(context.role, 'engineer') ? true : 'reason.engineer',
    context.busy ? 'reason.busy' : true,
  );

export function registerTests(): void {
  registerPanel({
    id: 'tests',
    title: 'tests.title',
    icon: FlaskConical,
    component: lazy(() => import('./TestsPanel')),
    position: 'bottom',
    order: 30,
  });

  registerCommands([
    {
      id: 'build.runTests',
      title: 'tests.run',
      icon: FlaskConical,
      menu: { menu: 'build', group: '3_tests' },
      enabled: runnable,
      run: runTests,
    },
    {
      id: 'build.runFailedTests',
      title: 'tests.runFailed',
      icon: RotateCcw,
      menu: { menu: 'build', group: '3_tests' },
      enabled: (context) => {
        const last = lastRunOf(context.projectId);
        return allOf(runnable(context), last && namesOfBad(last.report).length > 0 ? true : 'tests.noneFailed');
      },
      run: runFailedTests,
    },
  ]);
}
