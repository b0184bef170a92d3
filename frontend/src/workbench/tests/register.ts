/** The results of unit tests and the command that runs them. */
import { FlaskConical, RotateCcw } from 'lucide-react';
import { registerCommands } from '../commands';
import { registerPanel } from '../panels';
import { application, engineer, idle, when, type Condition } from '../conditions';
import { namesOfFailed, runFailedTests, runTests } from './store';
import { onDemand } from '@/ui/onDemand';

const someFailed: Condition = (context) => (namesOfFailed(context).length > 0 ? true : 'tests.noneFailed');

export function registerTests(): void {
  registerPanel({
    id: 'tests',
    title: 'tests.title',
    icon: FlaskConical,
    component: onDemand(() => import('./TestsPanel')),
    position: 'bottom',
    order: 30,
  });

  registerCommands([
    {
      id: 'build.runTests',
      title: 'tests.run',
      icon: FlaskConical,
      menu: { menu: 'build', group: '3_tests' },
      enabled: when(application, engineer, idle),
      run: runTests,
    },
    {
      id: 'build.runFailedTests',
      title: 'tests.runFailed',
      icon: RotateCcw,
      menu: { menu: 'build', group: '3_tests' },
      enabled: when(application, engineer, idle, someFailed),
      run: runFailedTests,
    },
  ]);
}
