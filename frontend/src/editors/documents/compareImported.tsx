/** Opens the comparison of an imported object with that of the project. */
import { openDialog } from '@/ui/dialogs';
import { loadMonaco } from '@/text/monacoLoader';
import type { ComparedObject } from '@/workbench/exchange/comparison';
import { CompareImportDialog } from './CompareImportDialog';

export async function compareImported(compared: ComparedObject): Promise<Record<string, string> | undefined> {
  const monaco = await loadMonaco();
  return openDialog<Record<string, string>>((close) => (
    <CompareImportDialog monaco={monaco} compared={compared} close={close} />
  ));
}
