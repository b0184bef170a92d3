import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { openDialog } from '@/workbench/dialogs';
import { guard } from '@/workbench/notices';
import { renameObject } from '@/workbench/tree/acts';
import type { TextDocument } from '../documents/documents';
import styles from './DeclarationTable.module.css';
import { HeaderDialog } from './HeaderDialog';
import { headerValues, setHeader, type HeaderValues } from './header';
import type { DeclarationModel } from './model';

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
    return (
      <div className={styles.header} style={{ cursor: 'default' }}>
        <b>{model.blocks[0]?.scope ?? ''}</b> {object.name}
      </div>
    );
  }
  const rest = model.text.slice(model.header.name?.end ?? model.header.range.end, model.header.range.end).trim();
  const edit = async () => {
    const next = await openDialog<HeaderValues>((close) => <HeaderDialog values={values} close={close} />);
    if (next === undefined) return;
    document.replaceText('declaration', setHeader(model.text, { ...next, name: values.name }));
    if (next.name !== values.name) await rename(document, object, next.name);
  };
  return (
    <button
      type="button"
      className={styles.header}
      title={locked ? t('decl.locked') : t('decl.editHeader')}
      aria-disabled={locked}
      onClick={() => !locked && void edit()}
    >
      <b>{values.keyword}</b>
      <span>{values.name}</span>
      <i>{rest}</i>
      <i>{values.comment.split('\n')[0]}</i>
    </button>
  );
}

/** The object's name and its header belong together: the server changes both and all that calls it by name. */
async function rename(document: TextDocument, object: ObjectSummary, name: string): Promise<void> {
  await document.save();
  await guard(() => renameObject(document.projectId, object, name));
}
