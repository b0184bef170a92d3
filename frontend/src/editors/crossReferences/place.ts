/** Uses of what stands at a place of a text. */
import { toPosition } from '@/lsp/convert';
import type { TextPlace } from '@/text/focus';
import { showPanel } from '@/workbench/docking/dock';
import { findCrossReferences } from './store';

export async function showCrossReferencesAt(projectId: string, place: TextPlace): Promise<void> {
  const model = place.getModel();
  const position = place.getPosition();
  if (model === null || position === null) return;
  const word = model.getWordAtPosition(position)?.word ?? '';
  showPanel('crossReferences', false);
  const textDocument = { uri: model.uri.toString() };
  await findCrossReferences(projectId, { textDocument, position: toPosition(position) }, word);
}
