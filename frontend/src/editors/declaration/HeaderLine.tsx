import type { ReactNode } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import { guard } from '@/ui/notices';
import { renameObject } from '@/workbench/tree/acts';
import type { TextDocument } from '@/text/documents';
import styles from './DeclarationTable.module.css';
import { AttributesDialog } from './AttributesDialog';
import { attributeLines } from '@/iec/declaration/cells';
import { HeaderDialog } from './HeaderDialog';
import { headerValues, setHeader, setListAttributes, type HeaderValues } from '@/iec/declaration/header';
import type { DeclarationModel } from '@/iec/declaration/model';

interface HeaderLineProps {
  object: ObjectSummary;
  document: TextDocument;
  model: DeclarationModel;
  locked: boolean;
}

/** Keyword and name above the table; a click opens the header dialog (DECL-22). */
export function HeaderLine({ object, document, model, locked }: HeaderLineProps) {
  const t = useText();
  const values = headerValues(model.text);
  if (values === null || model.header === null) {
    return <ListHeader object={object} document={document} model={model} locked={locked} />;
  }
  const rest = model.text.slice(model.header.name?.end ?? model.header.range.end, model.header.range.end).trim();
  const edit = async () => {
    const next = await openDialog<HeaderValues>((close) => <HeaderDialog values={values} close={close} />);
    if (next === undefined) return;
    document.replaceText('declaration', setHeader(model.text, { ...next, name: values.name }));
    if (next.name !== values.name) await rename(document, object, next.name);
  };
  return (
    <HeaderButton title={t('decl.editHeader')} locked={locked} edit={edit}>
      <b>{values.keyword}</b>
      <span>{values.name}</span>
      <i>{rest}</i>
      <i>{values.comment.split('\n')[0]}</i>
    </HeaderButton>
  );
}

/** A variable list has no header of its own: its frame, its name and its pragmas. */
function ListHeader({ object, document, model, locked }: HeaderLineProps) {
  const t = useText();
  const lines = attributeLines({ attributes: model.listAttributes });
  const edit = async () => {
    const text = await openDialog<string>((close) => <AttributesDialog value={lines.join('\n')} close={close} />);
    if (text === undefined) return;
    const next = text
      .split('\n')
      .map((line) => line.trim())
      .filter((line) => line !== '');
    document.replaceText('declaration', setListAttributes(model.text, next));
  };
  return (
    <HeaderButton title={t('decl.editAttributes')} locked={locked} edit={edit}>
      <b>{model.blocks[0]?.scope ?? ''}</b>
      <span>{object.name}</span>
      <i>{lines.map((line) => `{${line}}`).join(' ')}</i>
    </HeaderButton>
  );
}

/** The object's name and its header belong together: the server changes both and all that calls it by name. */
async function rename(document: TextDocument, object: ObjectSummary, name: string): Promise<void> {
  await document.save();
  await guard(() => renameObject(document.projectId, object, name));
}

interface HeaderButtonProps {
  title: string;
  locked: boolean;
  edit: () => Promise<void>;
  children: ReactNode;
}

/** The line of a declaration that a click edits in a dialog. */
function HeaderButton({ title, locked, edit, children }: HeaderButtonProps) {
  const t = useText();
  return (
    <button
      type="button"
      className={styles.header}
      title={locked ? t('decl.locked') : title}
      aria-disabled={locked}
      onClick={() => !locked && void edit()}
    >
      {children}
    </button>
  );
}
