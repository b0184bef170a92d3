/** Scripts of users: the Tools menu with a command for each of them, and the panel of what they write. */
import { CircleStop, FileCode, FilePlus2, Play } from 'lucide-react';
import { keys, queryClient } from '@/api/queries';
import { hasRole, kindWithRole } from '@/project/kinds';
import { useProject } from '@/project/openProject';
import { onDemand } from '@/ui/onDemand';
import { contextChanged, registerCommand, registerCommands, type MenuPlace } from '@/workbench/commands';
import { project, when, type Condition } from '@/workbench/conditions';
import { registerPanel } from '@/workbench/panels';
import { mayEdit } from '@/workbench/rights';
import { runCommand } from '@/workbench/run';
import { runScript, scriptRuns, scriptsOf, stopScript, useScriptRun } from './runner';

const still: Condition = () => (scriptRuns() ? 'scripts.runs' : true);

const place = (order: number): MenuPlace => ({ menu: 'tools', group: '3_scripts', order, submenu: 'scripts.title' });

export function registerScripts(): void {
  registerPanel({
    id: 'scripts',
    title: 'scripts.title',
    icon: FileCode,
    component: onDemand(() => import('./ScriptsPanel')),
    position: 'bottom',
    order: 75,
  });
  registerCommands([
    {
      id: 'scripts.new',
      title: 'scripts.new',
      icon: FilePlus2,
      menu: place(1),
      enabled: when(project, mayEdit),
      run: () => runCommand('project.addObject', { kind: kindWithRole('script')?.kind, parentId: null, view: 'pous' }),
    },
    {
      id: 'scripts.stop',
      title: 'scripts.stop',
      icon: CircleStop,
      menu: place(2),
      enabled: () => (scriptRuns() ? true : 'scripts.notRunning'),
      run: stopScript,
    },
  ]);
  useScriptRun.subscribe((now, before) => {
    if (now.run?.state !== before.run?.state) contextChanged();
  });
  followScripts();
}

/** One command a script, as long as the script is there. */
function followScripts(): void {
  let shown = '';
  let forget: (() => void)[] = [];
  const renew = () => {
    const { projectId } = useProject.getState();
    const scripts = scriptsOf(projectId, (object) => hasRole(object, 'script'));
    const now = JSON.stringify([projectId, scripts.map(({ id, name }) => [id, name])]);
    if (now === shown) return;
    shown = now;
    forget.forEach((one) => one());
    forget = scripts.map(({ id, name }, order) =>
      registerCommand({
        id: `scripts.run.${id}`,
        title: 'scripts.run',
        titleValues: { name },
        icon: Play,
        menu: place(10 + order),
        enabled: still,
        run: () => runScript(projectId!, id),
      }),
    );
  };
  useProject.subscribe(renew);
  queryClient.getQueryCache().subscribe(({ query }) => {
    const { projectId } = useProject.getState();
    if (projectId !== null && query.queryHash === JSON.stringify(keys.objects(projectId))) renew();
  });
}
