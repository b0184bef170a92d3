import { useState } from 'react';
import type { LibraryReference, LibrarySummary } from '@/api/types';
import { useText } from '@/i18n';
import { Button } from '@/workbench/ui/Button';
import { Dialog } from '@/workbench/ui/Dialog';
import { Field, Select, TextInput } from '@/workbench/ui/Field';
import { compareVersions, namespaceFault, namespaceOf } from './model';

interface LibraryPropertiesProps {
  reference: LibraryReference;
  at: number;
  references: readonly LibraryReference[];
  installed: readonly LibrarySummary[];
  close: (edited?: LibraryReference) => void;
}

/** Namespace and version of a library in use. */
export function LibraryPropertiesDialog({ reference, at, references, installed, close }: LibraryPropertiesProps) {
  const t = useText();
  const [namespace, setNamespace] = useState(reference.namespace);
  const [version, setVersion] = useState(reference.version);
  const fault = namespaceFault(namespace, at, references, installed);
  const versions = installed
    .filter((library) => library.name === reference.name)
    .map((library) => library.version)
    .sort((a, b) => compareVersions(b, a));
  const choices = [...new Set(['*', reference.version, ...versions])].map((value) => ({
    value,
    text: value === '*' ? t('library.newest') : value,
  }));
  return (
    <Dialog
      title={t('library.propertiesOf', { name: reference.name })}
      width={420}
      onClose={() => close()}
      onSubmit={() => !fault && close({ ...reference, namespace, version })}
      footer={
        <>
          <Button onClick={() => close()}>{t('action.cancel')}</Button>
          <Button type="submit" variant="primary" disabledReason={fault && t(fault)}>
            {t('action.apply')}
          </Button>
        </>
      }
    >
      <Field label={t('library.namespace')} error={fault && t(fault)} hint={t('library.namespaceHint')}>
        {(attributes) => (
          <TextInput
            {...attributes}
            className="code"
            value={namespace}
            placeholder={namespaceOf({ ...reference, namespace: '' }, installed)}
            onValue={setNamespace}
          />
        )}
      </Field>
      <Field label={t('library.version')}>
        {(attributes) => <Select {...attributes} value={version} choices={choices} onValue={setVersion} />}
      </Field>
    </Dialog>
  );
}
