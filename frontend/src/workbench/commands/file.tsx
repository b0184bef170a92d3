import { FilePlus, FolderOpen, LogOut, SquareArrowOutUpLeft } from 'lucide-react';
import { api } from '@/api/client';
import { queryClient } from '@/api/queries';
import { go } from '@/session/route';
import { setUser, useSession } from '@/session/session';
import { registerCommands, type Command } from '../commands';
import { engineer, project } from '../conditions';
import { closeEditors } from '../docking/close';
import { useSelection } from '../selection';

/** Leaves the project after asking about unsaved changes; false when the user stays. */
export async function leaveProject(): Promise<boolean> {
  const dirty = [...useSelection.getState().dirty];
  return dirty.length === 0 || closeEditors(dirty);
}

const commands: Command[] = [
  {
    id: 'file.newProject',
    title: 'command.newProject',
    icon: FilePlus,
    menu: { menu: 'file', group: '1_project', order: 1 },
    enabled: engineer,
    run: async () => {
      const { newProject } = await import('../projectInfo/NewProjectDialog');
      const project = await newProject();
      if (project && (await leaveProject())) go({ page: 'project', projectId: project.id });
    },
  },
  {
    id: 'file.openProject',
    title: 'command.openProject',
    icon: FolderOpen,
    keys: ['Ctrl+O'],
    menu: { menu: 'file', group: '1_project', order: 2 },
    run: async () => {
      if (await leaveProject()) go({ page: 'start' });
    },
  },
  {
    id: 'file.closeProject',
    title: 'command.closeProject',
    icon: SquareArrowOutUpLeft,
    menu: { menu: 'file', group: '1_project', order: 3 },
    enabled: project,
    run: async () => {
      if (await leaveProject()) go({ page: 'start' });
    },
  },
  {
    id: 'file.signOut',
    title: 'command.signOut',
    icon: LogOut,
    menu: { menu: 'file', group: '9_session' },
    enabled: () => (useSession.getState().user ? true : 'reason.notHere'),
    run: async () => {
      if (!(await leaveProject())) return;
      await api.post('/api/v1/auth/logout');
      queryClient.clear();
      setUser(null);
    },
  },
];

export function registerFileCommands(): void {
  registerCommands(commands);
}
