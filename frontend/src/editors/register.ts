/** What the editors add to the workbench; their components are loaded when the first object opens. */
import { Waypoints } from 'lucide-react';
import { setSymbolActs } from '@/workbench/symbolActs';
import { partUri } from '@/project/partUri';
import { registerLanguage, type LanguageDescriptor } from '@/text/languages';
import { loadMonaco } from '@/text/monacoLoader';
import { setImportComparison } from '@/workbench/exchange/comparison';
import { setQuickFixSource } from '@/workbench/messages/quickFixes';
import { setSymbolSource } from '@/workbench/palette/symbolSource';
import { registerPanel } from '@/workbench/panels';
import { registerBreakpointCommands } from './online/breakpointCommands';
import { registerTextCommands } from './text/commands';
import { fetchBeforehand, onDemand } from '@/ui/onDemand';

/** The folders of the languages, found by their place. */
const LANGUAGES = import.meta.glob<LanguageDescriptor>('./*/index.ts', { eager: true, import: 'default' });

/** Makes languages known and answers them. */
export function registerLanguages(found: Readonly<Record<string, LanguageDescriptor>> = LANGUAGES) {
  const languages = Object.values(found);
  languages.forEach(registerLanguage);
  return languages;
}

export function registerEditors(): void {
  registerPanel({
    id: 'crossReferences',
    title: 'panel.crossReferences',
    icon: Waypoints,
    component: onDemand(() => import('./crossReferences/CrossReferencePanel')),
    position: 'bottom',
    order: 55,
  });
  registerLanguages();
  registerBreakpointCommands();
  fetchBeforehand(loadMonaco);
  setQuickFixSource(async (message, show) => {
    const { quickFixesOfMessage } = await import('./text/quickFixes');
    return quickFixesOfMessage(message, show);
  });
  setSymbolActs({
    goToDefinition: async (expression) => (await import('./crossReferences/expressions')).goToDefinitionOf(expression),
    showCrossReferences: async (expression) =>
      (await import('./crossReferences/expressions')).showCrossReferencesOf(expression),
  });
  setSymbolSource({
    project: async (projectId, query) => (await import('@/lsp/symbols')).projectSymbols(projectId, query),
    members: async (projectId, objectId, part) =>
      (await import('@/lsp/symbols')).documentSymbols(projectId, partUri(projectId, objectId, part)),
  });
  setImportComparison(async (compared) => {
    const { compareImported } = await import('./documents/compareImported');
    return compareImported(compared);
  });
  registerTextCommands();
}
