import { useMemo } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import { useProject } from '@/project/openProject';
import { InputAssistant } from '../assistant/InputAssistant';
import { CellInput } from '@/ui/grid/CellInput';
import grid from '@/ui/grid/CellInput.module.css';
import { ELEMENTARY_TYPES } from '@/iec/grammar';
import { identifierProblem } from '@/iec/keywords';
import type { Monaco } from '@/text/monacoLoader';
import { ArrayWizard } from './ArrayWizard';
import { InitialValueDialog } from './InitialValueDialog';
import type { DeclarationModel } from '@/iec/declaration/model';
import { ScopeCell } from './ScopeCell';
import { cellText, DRAFT_KEY, type Draft } from './tableModel';
import { TypeButton } from './TypeButton';
import type { CommittedCell } from './useTableActs';

interface CellEditorProps {
  column: string;
  /** Number of the row in the text, or DRAFT_KEY. */
  row: number;
  initial: string | undefined;
  model: DeclarationModel;
  draft: Draft | null;
  object: ObjectSummary;
  monaco: Monaco;
  onCommit: (cell: CommittedCell) => void;
  onCancel: () => void;
}

/** What edits a cell of the declaration table, by column (DECL-24 .. DECL-32). */
export function CellEditor(props: CellEditorProps) {
  const { column, row: index, model, object, onCommit, onCancel } = props;
  const t = useText();
  const projectId = useProject((state) => state.projectId) ?? '';
  const row = index === DRAFT_KEY ? undefined : model.rows[index];
  const value = row === undefined ? '' : cellText(model, row, column);
  const commit = (text: string, key: CommittedCell['key'] = 'Enter', backwards = false) =>
    onCommit({ row: index, column, value: text, key, backwards });
  const types = useMemo(() => [...ELEMENTARY_TYPES], []);

  const chooseType = async () => {
    const chosen = await openDialog<string>((close) => (
      <InputAssistant projectId={projectId} object={object} category="types" close={close} />
    ));
    if (chosen === undefined) onCancel();
    else commit(chosen, 'blur');
  };
  const makeArray = async (present: string) => {
    const chosen = await openDialog<string>((close) => (
      <ArrayWizard projectId={projectId} object={object} type={present} close={close} />
    ));
    if (chosen === undefined) onCancel();
    else commit(chosen, 'blur');
  };
  const editInitial = async (present: string) => {
    const chosen = await openDialog<string>((close) => (
      <InitialValueDialog
        projectId={projectId}
        name={row?.name.text ?? ''}
        type={row?.type?.text ?? ''}
        initial={present}
        close={close}
      />
    ));
    if (chosen === undefined) onCancel();
    else commit(chosen, 'blur');
  };

  const label = t('decl.editCell', { column });
  const checkName = (text: string) => {
    const problem = identifierProblem(text.trim());
    return problem === null ? null : t(`decl.identifier.${problem}`, { name: text.trim() });
  };
  const checkAddress = (text: string) =>
    text.trim() === '' || /^%[IQM](\*|[XBWDL]?\d+(\.\d+)*)$/i.test(text.trim())
      ? null
      : t('decl.badAddress', { text: text.trim() });

  switch (column) {
    case 'scope':
      return <ScopeCell model={model} value={value} onCommit={(text) => commit(text, 'blur')} onCancel={onCancel} />;
    case 'comment':
      return (
        <CellInput
          label={label}
          value={value}
          initial={props.initial}
          multiline
          onCommit={commit}
          onCancel={onCancel}
        />
      );
    case 'type':
      return (
        <CellInput
          label={label}
          value={value}
          initial={props.initial}
          suggestions={types}
          check={(text) => (text.trim() === '' ? t('decl.typeNeeded') : null)}
          onCommit={commit}
          onCancel={onCancel}
          button={(text) => <TypeButton onAssistant={() => void chooseType()} onArray={() => void makeArray(text)} />}
        />
      );
    case 'initial':
      return (
        <CellInput
          label={label}
          value={value}
          initial={props.initial}
          onCommit={commit}
          onCancel={onCancel}
          button={(text) => (
            <button
              type="button"
              className={grid.button}
              title={t('decl.initialDialog')}
              onClick={() => void editInitial(text)}
            >
              …
            </button>
          )}
        />
      );
    default:
      return (
        <CellInput
          label={label}
          value={value}
          initial={props.initial}
          check={column === 'name' ? checkName : checkAddress}
          onCommit={commit}
          onCancel={onCancel}
        />
      );
  }
}
