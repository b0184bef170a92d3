import { useCallback, useEffect, useRef, type RefObject } from 'react';
import { applyTextEdits } from '@/lsp/convert';
import type { TextEdit } from '@/lsp/protocol';
import { activeLanguageClient } from '@/lsp/session';
import { indentation, useEditorSettings } from '@/text/settings';
import type { GridSelection } from '@/ui/grid/useGridSelection';
import type { TextDocument } from '@/text/documents';
import { rename, showCrossReferences, type TextPanel } from '../text/acts';
import { setPanelChosen, setPanelTable, type PanelTable, type TextPlace } from '@/text/focus';
import { ACTIONS } from '../text/actions';
import { clipboardActs } from './menu';
import type { RowMessage } from './messages';
import type { useIlActs } from './useIlActs';

interface TableInput {
  panelId: string;
  panel: TextPanel;
  acts: ReturnType<typeof useIlActs>;
  place: TextPlace;
  locked: boolean;
  selection: GridSelection;
  messages: ReadonlyMap<number, readonly RowMessage[]>;
  /** Carries out an act of the text editor, in the text. */
  inText: (action: string) => void;
}

/** Makes the table the one that commands mean; answers what is to be called when it gets the focus. */
export function useTableOfPanel(input: TableInput): () => void {
  const now = useRef(input);
  const table = useRef<PanelTable | null>(null);
  useEffect(() => {
    now.current = input;
  });
  const { panelId } = input;
  // The body is what commands mean until another part of the panel is entered.
  useEffect(() => {
    table.current = tableOf(now);
    setPanelTable(panelId, table.current);
    return () => setPanelTable(panelId, null);
  }, [panelId]);
  return useCallback(() => {
    setPanelChosen(panelId, null);
    setPanelTable(panelId, table.current);
  }, [panelId]);
}

/** The table as commands see it, always with what it shows at the moment. */
function tableOf(now: RefObject<TableInput>): PanelTable {
  const history = () =>
    now.current.panel.document.models.implementation as unknown as Record<'undo' | 'redo', () => void>;
  const step = (which: 'undo' | 'redo') => () => {
    if (!now.current.locked) history()[which]();
  };
  const clipboard = (which: 'cut' | 'copy' | 'paste') => () => clipboardActs(now.current.acts)[which]();
  const inText = Object.fromEntries(
    Object.entries(ACTIONS).map(([command, id]) => [command, () => now.current.inText(id)]),
  );
  return {
    undo: step('undo'),
    redo: step('redo'),
    place: {
      getModel: () => now.current.place.getModel(),
      getPosition: () => now.current.place.getPosition(),
      getSelection: () => now.current.place.getSelection(),
      focus: () => now.current.place.focus(),
    },
    jumps: true,
    acts: {
      ...inText,
      'edit.cut': clipboard('cut'),
      'edit.copy': clipboard('copy'),
      'edit.paste': clipboard('paste'),
      'edit.selectAll': () => now.current.acts.selectAll(),
      'st.inputAssistant': () => now.current.acts.assist(),
      'st.goToDefinition': () => now.current.acts.definition(),
      'st.renameSymbol': () => {
        // What an open cell holds would bring the old name back.
        now.current.acts.leaveCell();
        return rename(now.current.panel, now.current.place);
      },
      'st.peekReferences': () => showCrossReferences(now.current.panel, now.current.place),
      'il.negate': () => now.current.acts.negate(),
      'il.toggleNetwork': () => now.current.acts.toggleNetwork(),
      'st.suggest': () => now.current.acts.suggest(),
      'st.parameters': () => undefined,
      'st.format': () => now.current.acts.change(() => void format(now.current.panel.document)),
      'st.nextProblem': () => stepProblem(now.current, 1),
      'st.previousProblem': () => stepProblem(now.current, -1),
    },
  };
}

/** Formats the body as in the text editor, in one step that can be undone. */
async function format(document: TextDocument): Promise<void> {
  const model = document.models.implementation;
  const version = model.getVersionId();
  const options = indentation(useEditorSettings.getState());
  const params = { textDocument: { uri: model.uri.toString() }, options };
  const edits = await activeLanguageClient()?.request<TextEdit[]>('textDocument/formatting', params);
  if (edits == null || model.isDisposed() || model.getVersionId() !== version) return;
  document.replaceText('implementation', applyTextEdits(model.getValue(), edits));
}

function stepProblem({ messages, selection }: TableInput, by: 1 | -1): void {
  const found = [...messages.keys()].sort((a, b) => a - b);
  const at = selection.cursor?.row ?? -1;
  const next =
    by > 0 ? (found.find((row) => row > at) ?? found[0]) : (found.findLast((row) => row < at) ?? found.at(-1));
  if (next !== undefined) selection.move({ row: next, column: Math.max(1, selection.cursor?.column ?? 1) }, 'one');
}
