/** Declaration and uses of a variable of an online table, which is known by its expression. */
import { t } from '@/i18n';
import { openLocation } from '@/lsp/session';
import { crossReferences } from '@/lsp/symbols';
import { useProject } from '@/project/openProject';
import { notify } from '@/ui/notices';
import { showPanel } from '@/workbench/docking/dock';
import { findCrossReferences } from './store';

export async function goToDefinitionOf(expression: string): Promise<void> {
  const { projectId } = useProject.getState();
  if (projectId === null) return;
  const places = await crossReferences(projectId, { name: expression });
  const declared = places.find((place) => place.access === 'declaration');
  const at = declared?.range.start;
  const opened =
    declared !== undefined &&
    at !== undefined &&
    openLocation(declared.uri, { line: at.line + 1, column: at.character + 1 });
  if (!opened) notify({ tone: 'info', title: t('st.noDefinition') });
}

export async function showCrossReferencesOf(expression: string): Promise<void> {
  const { projectId } = useProject.getState();
  if (projectId === null) return;
  showPanel('crossReferences', false);
  await findCrossReferences(projectId, { name: expression }, expression);
}
