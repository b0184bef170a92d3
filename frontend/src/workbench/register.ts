/** What the workbench itself brings: its tool panels and the commands of the menus. */
import {
  CircleDot,
  FileText,
  FolderTree,
  Layers,
  Library,
  ListChecks,
  ScrollText,
  SquareFunction,
  Timer,
  Zap,
} from 'lucide-react';
import { registerEditCommands } from './commands/edit';
import { registerExchangeCommands } from './commands/exchange';
import { registerFileCommands } from './commands/file';
import { registerHelpCommands } from './commands/help';
import { registerLibraryCommands } from './commands/libraries';
import { registerOnlineCommands } from './commands/online';
import { registerProjectCommands } from './commands/project';
import { registerSourceCommands } from './commands/source';
import { registerVersionCommands } from './commands/versions';
import { registerStaticAnalysisCommands } from './commands/staticAnalysis';
import { registerToolsCommands } from './commands/tools';
import { registerViewCommands } from './commands/view';
import { registerWindowCommands } from './commands/window';
import { registerDebuggerCommands } from './debugger/commands';
import { followDebugger } from './debugger/follow';
import { useMessageBadge } from './messages/badge';
import MessagesPanel from './messages/MessagesPanel';
import { translateMessages } from './messages/store';
import { sayAgain } from './sayAgain';
import { followExceptions } from './online/exception';
import { registerPanel } from './panels';
import { registerTests } from './tests/register';
import TreePanel from './tree/TreePanel';
import { onLanguageChange } from '@/i18n';
import { guard } from '@/ui/notices';
import { onDemand } from '@/ui/onDemand';

export function registerWorkbench(): void {
  registerPanel({
    id: 'devices',
    title: 'panel.devices',
    icon: FolderTree,
    component: TreePanel,
    props: { view: 'devices' },
    position: 'left',
    order: 1,
    initial: true,
  });
  registerPanel({
    id: 'pous',
    title: 'panel.pous',
    icon: SquareFunction,
    component: TreePanel,
    props: { view: 'pous' },
    position: 'left',
    order: 2,
    initial: true,
  });
  registerPanel({
    id: 'libraries',
    title: 'panel.libraries',
    icon: Library,
    component: onDemand(() => import('./libraries/LibrariesPanel')),
    position: 'left',
    order: 3,
    initial: true,
  });
  registerPanel({
    id: 'messages',
    title: 'panel.messages',
    icon: ListChecks,
    component: MessagesPanel,
    position: 'bottom',
    order: 10,
    initial: true,
    useBadge: useMessageBadge,
  });
  registerPanel({
    id: 'tasks',
    title: 'panel.tasks',
    icon: Timer,
    component: onDemand(() => import('./online/TasksPanel')),
    position: 'bottom',
    order: 60,
    initial: true,
  });
  registerPanel({
    id: 'onlineChanges',
    title: 'panel.onlineChanges',
    icon: Zap,
    component: onDemand(() => import('./online/ChangesPanel')),
    position: 'bottom',
    order: 62,
  });
  registerPanel({
    id: 'callStack',
    title: 'panel.callStack',
    icon: Layers,
    component: onDemand(() => import('./online/CallStackPanel')),
    position: 'bottom',
    order: 50,
  });
  registerPanel({
    id: 'log',
    title: 'panel.log',
    icon: ScrollText,
    component: onDemand(() => import('./online/LogPanel')),
    position: 'bottom',
    order: 70,
    initial: true,
  });
  registerPanel({
    id: 'libraryDoc',
    title: 'panel.libraryDoc',
    icon: FileText,
    component: onDemand(() => import('./libraries/LibraryDocPanel')),
    position: 'right',
    order: 40,
  });
  registerPanel({
    id: 'breakpoints',
    title: 'panel.breakpoints',
    icon: CircleDot,
    component: onDemand(() => import('./debugger/BreakpointsPanel')),
    position: 'bottom',
    order: 48,
  });
  registerTests();
  registerFileCommands();
  registerExchangeCommands();
  registerEditCommands();
  registerProjectCommands();
  registerOnlineCommands();
  registerDebuggerCommands();
  followDebugger();
  registerSourceCommands();
  registerVersionCommands();
  registerLibraryCommands();
  registerStaticAnalysisCommands();
  registerToolsCommands();
  registerWindowCommands();
  registerHelpCommands();
  followExceptions();
  onLanguageChange(() => {
    void guard(translateMessages);
    void guard(sayAgain);
  });
}

/** The entries of the View menu; after all rooms have registered their panels. */
export function registerPanelCommands(): void {
  registerViewCommands();
}
