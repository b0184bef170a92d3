import { useMemo, type Ref } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import { InputAssistant } from '../assistant/InputAssistant';
import type { TextDocument } from '@/text/documents';
import { CellInput, type CellInputHandle } from '@/ui/grid/CellInput';
import grid from '@/ui/grid/CellInput.module.css';
import { cellProblem } from './edits';
import { proposer } from './proposals';
import { cellText, type IlColumn, type IlRow } from './rows';

/** What ended the editing: a key, leaving the cell, or Ctrl+Enter, which goes on with a new row. */
export type EndedBy = 'Enter' | 'Tab' | 'BackTab' | 'NewRow' | 'blur';

interface IlCellEditorProps {
  projectId: string;
  object: ObjectSummary;
  document: TextDocument;
  row: IlRow;
  index: number;
  column: IlColumn;
  initial: string | undefined;
  handle: Ref<CellInputHandle>;
  onCommit: (content: string, by: EndedBy) => void;
  onCancel: () => void;
}

/** Edits a cell of the IL table in place, with what the language server proposes (IL-04). */
export function IlCellEditor(props: IlCellEditorProps) {
  const { projectId, object, document, row, index, column, onCommit, onCancel } = props;
  const t = useText();
  const code = column !== 'comment';
  const propose = useMemo(
    () => (code && row.kind !== 'raw' && row.kind !== 'label' ? proposer(document, index, column) : undefined),
    [code, row.kind, document, index, column],
  );
  const check = (content: string) => {
    const problem = cellProblem(row, column, content);
    return problem === null ? null : t(`il.refused.${problem}`);
  };
  const assist = async (present: string) => {
    const typed = /[\p{L}\p{N}_]*$/u.exec(present)?.[0] ?? '';
    const chosen = await openDialog<string>((close) => (
      <InputAssistant projectId={projectId} object={object} typed={typed} close={close} />
    ));
    if (chosen === undefined) onCancel();
    else onCommit(present.slice(0, present.length - typed.length) + chosen, 'blur');
  };
  return (
    <CellInput
      handle={props.handle}
      label={t('il.editCell', { column: t(`il.column.${column}`) })}
      value={cellText(row, column)}
      initial={props.initial}
      multiline={column === 'comment' || row.kind === 'raw'}
      check={check}
      propose={propose}
      onKey={(event, text) => {
        if (event.key !== 'Enter' || !event.ctrlKey || row.kind === 'comment') return false;
        if (check(text) === null) onCommit(text, 'NewRow');
        return true;
      }}
      onCommit={(text, key, backwards) => onCommit(text, key === 'Tab' && backwards ? 'BackTab' : key)}
      onCancel={onCancel}
      button={
        column === 'operand' || row.kind === 'instruction' || row.kind === 'blank'
          ? (text) =>
              code && (
                <button
                  type="button"
                  tabIndex={-1}
                  className={grid.button}
                  title={`${t('assistant.title')} (F2)`}
                  aria-label={t('assistant.title')}
                  onClick={() => void assist(text)}
                >
                  …
                </button>
              )
          : undefined
      }
    />
  );
}
