import { ofKind } from '@/api/objects';
import { objectIcon } from '@/project/kinds';
import type { EditorProps } from '@/project/editorProps';
import { displayName } from '@/project/objectName';
import { FormPage } from '@/editors/form/FormPage';
import styles from '@/editors/form/Form.module.css';
import { useDraft } from '@/editors/form/useDraft';
import { canStore } from './model';
import { PageSetupForm } from './PageSetupForm';

const Icon = objectIcon('page_setup');

/** The page setup that the project holds. */
export default function PageSetupEditor({ panelId, projectId, objectId }: EditorProps) {
  const draft = useDraft(panelId, projectId, objectId, ofKind('page_setup'), canStore);
  return (
    <FormPage draft={draft} wide>
      {(setup) => (
        <>
          <h1 className={styles.title}>
            <Icon size={20} />
            {draft.object && displayName(draft.object)}
          </h1>
          <PageSetupForm setup={setup} disabled={draft.readOnly !== null} onChange={draft.change} />
        </>
      )}
    </FormPage>
  );
}
