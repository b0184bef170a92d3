import { useState } from 'react';
import type { LibraryReference, LibrarySummary } from '@/api/types';
import { useText } from '@/i18n';
import { FormDialog } from '@/ui/FormDialog';
import { namespaceFault } from './model';
import { placeholderFault, ReferenceFields } from './ReferenceFields';

interface LibraryPropertiesProps {
  reference: LibraryReference;
  at: number;
  references: readonly LibraryReference[];
  installed: readonly LibrarySummary[];
  close: (edited?: LibraryReference) => void;
}

/** Version, namespace and placeholder of a library in use. */
export function LibraryPropertiesDialog({ reference, at, references, installed, close }: LibraryPropertiesProps) {
  const t = useText();
  const [edited, setEdited] = useState(reference);
  const fault = namespaceFault(edited, at, references, installed);
  const refused = fault ? t(fault) : placeholderFault(edited) ? t('library.namespaceFault') : null;
  return (
    <FormDialog
      title={t('library.propertiesOf', { name: reference.name })}
      width={420}
      onClose={() => close()}
      onSubmit={() => close(edited)}
      action={t('action.apply')}
      disabledReason={refused}
    >
      <ReferenceFields reference={edited} at={at} references={references} installed={installed} change={setEdited} />
    </FormDialog>
  );
}
