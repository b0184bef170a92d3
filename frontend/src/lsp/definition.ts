import { t } from '@/i18n';
import type { TextPlace } from '@/text/focus';
import { notify } from '@/ui/notices';
import { toPosition } from './convert';
import type { Location, LocationLink } from './protocol';
import { activeLanguageClient, openLocation } from './session';

/** F12 where no Monaco editor stands: opens what is declared at a place of a text. */
export async function goToDefinition(place: TextPlace): Promise<void> {
  const model = place.getModel();
  const position = place.getPosition();
  if (model === null || position === null) return;
  const params = { textDocument: { uri: model.uri.toString() }, position: toPosition(position) };
  const answer = await activeLanguageClient()?.request<Location | (Location | LocationLink)[]>(
    'textDocument/definition',
    params,
  );
  const first = Array.isArray(answer) ? answer[0] : answer;
  const found =
    first != null && 'targetUri' in first ? { uri: first.targetUri, range: first.targetSelectionRange } : first;
  const at = found?.range.start;
  const opened =
    found != null && at !== undefined && openLocation(found.uri, { line: at.line + 1, column: at.character + 1 });
  if (!opened) notify({ tone: 'info', title: t('st.noDefinition') });
}
