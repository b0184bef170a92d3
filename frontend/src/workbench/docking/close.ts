import { t } from '@/i18n';
import { useRegistry } from '../commands';
import { openDialog } from '@/ui/dialogs';
import { guard } from '@/ui/notices';
import { setDirty, useSelection } from '../selection';
import { dockApi } from './dock';
import { createElement } from 'react';
import { UnsavedDialog, type UnsavedAnswer } from './UnsavedDialog';

/** Closes editors; asks first where changes are not saved. False when the user chose to stay. */
export async function closeEditors(panelIds: readonly string[]): Promise<boolean> {
  const api = dockApi();
  if (!api) return true;
  const { dirty } = useSelection.getState();
  const unsaved = panelIds.filter((id) => dirty.has(id));
  if (unsaved.length > 0) {
    const names = unsaved.map((id) => api.getPanel(id)?.title ?? id);
    const answer = await openDialog<UnsavedAnswer>((close) => createElement(UnsavedDialog, { names, close }));
    if (!answer) return false;
    if (answer === 'save' && !(await saveEditors(unsaved))) return false;
    if (answer === 'discard') unsaved.forEach((id) => setDirty(id, false));
  }
  for (const id of panelIds) api.getPanel(id)?.api.close();
  return true;
}

/** Saves through each editor's own `file.save`; false when one could not be saved. */
export async function saveEditors(panelIds: readonly string[]): Promise<boolean> {
  for (const id of panelIds) {
    const save = useRegistry.getState().handlers.get(id)?.['file.save'];
    if (!save) continue;
    await guard(async () => save.run());
    if (useSelection.getState().dirty.has(id)) return false;
  }
  return true;
}

/** What the browser says when the page is left with unsaved changes. */
export function warnBeforeLeaving(event: BeforeUnloadEvent): void {
  if (useSelection.getState().dirty.size > 0) {
    event.preventDefault();
    event.returnValue = t('unsaved.leave');
  }
}
