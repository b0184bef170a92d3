/** Search and replace in the project: the panel and its commands. */
import { Search } from 'lucide-react';
import { panelEditor } from '@/text/focus';
import { menuGroup, registerCommands } from '@/workbench/commands';
import { project, when } from '@/workbench/conditions';
import type { CommandContext } from '@/workbench/context';
import { showPanel } from '@/workbench/docking/dock';
import { onDemand } from '@/ui/onDemand';
import { registerPanel } from '@/workbench/panels';
import { mayEdit } from '@/workbench/rights';
import { changeForm, useSearch } from './store';

/** What is selected in the editor is what is looked for, unless it goes over lines. */
function selectedText(context: CommandContext): string {
  const editor = panelEditor(context.activeEditor?.panelId);
  const selection = editor?.getSelection();
  if (!editor || !selection || selection.startLineNumber !== selection.endLineNumber) return '';
  return editor.getModel()?.getValueInRange(selection) ?? '';
}

function openSearch(context: CommandContext, replacing: boolean): void {
  const text = selectedText(context);
  changeForm({ replacing, ...(text !== '' && { text }) });
  showPanel('search');
  useSearch.setState(({ focusSerial }) => ({ focusSerial: focusSerial + 1 }));
}

export function registerSearch(): void {
  registerPanel({
    id: 'search',
    title: 'search.title',
    icon: Search,
    component: onDemand(() => import('./SearchPanel')),
    position: 'left',
    order: 4,
  });
  registerCommands(
    menuGroup(
      'edit',
      '4_project',
      {
        id: 'edit.findInProject',
        title: 'command.findInProject',
        icon: Search,
        keys: ['Ctrl+Shift+F'],
        enabled: project,
        run: (context) => openSearch(context, false),
      },
      {
        id: 'edit.replaceInProject',
        title: 'command.replaceInProject',
        keys: ['Ctrl+Shift+H'],
        enabled: when(project, mayEdit),
        run: (context) => openSearch(context, true),
      },
    ),
  );
}
