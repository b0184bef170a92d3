import { libraryQuery, queryClient } from '@/api/queries';
import { showPanel } from '../docking/dock';
import { guard } from '@/ui/notices';
import { chooseItem } from './chosen';

/** Opens the documentation of a library item beside the editors, which keep the focus. */
export async function showDocumentation(library: string, name: string): Promise<void> {
  const contents = await guard(() => queryClient.fetchQuery(libraryQuery(library)));
  const item = contents?.items.find((one) => one.name.toUpperCase() === name.toUpperCase());
  if (item === undefined) return;
  chooseItem(library, item);
  showPanel('libraryDoc', false);
}
