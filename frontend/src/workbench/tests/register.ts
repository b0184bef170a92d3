/** The results of unit tests and the command that runs them. */
import { FlaskConical } from 'lucide-react';
import { lazy } from 'react';
import { registerCommands } from '../commands';
import { registerPanel } from '../panels';
import { allOf, atLeast } from '../rights';
import { runTests } from './store';

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
    enabled: (context) =>
      allOf(
        !context.projectId ? 'reason.noProject' : context.applicationId ? true : 'reason.noApplication',
        atLeast(context.role, 'engineer') ? true : 'reason.engineer',
        context.busy ? 'reason.busy' : true,
      ),
    run: runTests,
  },
]);
