/** What the editors add to the workbench; their components are loaded when the first object opens. */
import { Waypoints } from 'lucide-react';
import { lazy } from 'react';
import { partUri } from '@/project/partUri';
import type { LanguageDescriptor } from '@/text/languages';
import { registerCommands } from '@/workbench/commands';
import { setQuickFixSource } from '@/workbench/messages/quickFixes';
import { setSymbolSource } from '@/workbench/palette/symbolSource';
import { registerPanel } from '@/workbench/panels';
import { registerOptionGroup } from '@/workbench/tools/optionGroups';
import { registerTextCommands } from './st/commands';

/** The folders of the languages, found by their place. */
const LANGUAGES = import.meta.glob<LanguageDescriptor>('./*/index.ts', { eager: true, import: 'default' });

export function registerEditors(): void {
  registerPanel({
    id: 'crossReferences',
    title: 'panel.crossReferences',
    icon: Waypoints,
    component: lazy(() => import('./crossReferences/CrossReferencePanel')),
    position: 'bottom',
    order: 55,
  });
  for (const { commands, options } of Object.values(LANGUAGES)) {
    if (commands) registerCommands(commands);
    if (options) registerOptionGroup(options);
  }
  setQuickFixSource(async (message, show) => {
    const { quickFixesOfMessage } = await import('./st/quickFixes');
    return quickFixesOfMessage(message, show);
  });
  setSymbolSource({
    project: async (projectId, query) => (await import('@/lsp/symbols')).projectSymbols(projectId, query),
    members: async (projectId, objectId, part) =>
      (await import('@/lsp/symbols')).documentSymbols(projectId, partUri(projectId, objectId, part)),
  });
  registerTextCommands();
}
