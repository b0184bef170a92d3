/** What the commands of IL do while its body is shown as text; the table has acts of its own. */
import type { Handlers } from '@/workbench/commands';
import type { TextDocument } from '@/text/documents';
import { panelEditor, panelPlace } from '@/text/focus';
import { negateRows, toggleNetwork } from './edits';
import { parseRows, rowAt } from './rows';

export function ilHandlers(panelId: string, document: TextDocument): Handlers {
  const onRow = (edit: (text: string, row: number) => string) => ({
    run: () => {
      const place = panelPlace(panelId);
      const position = place?.getPosition() ?? null;
      const model = document.models.implementation;
      const readOnly = panelEditor(panelId)?.getRawOptions().readOnly === true;
      if (position === null || place?.getModel() !== model || readOnly) return;
      const text = model.getValue();
      const row = rowAt(parseRows(text), position.lineNumber, position.column);
      document.replaceText('implementation', edit(text, row));
    },
  });
  return { 'il.negate': onRow((text, row) => negateRows(text, [row])), 'il.toggleNetwork': onRow(toggleNetwork) };
}
