import type { LibraryReference, LibrarySummary } from '@/api/types';
import { useText } from '@/i18n';
import { Checkbox, Field, Select, TextInput } from '@/ui/Field';
import { libraryOf, namespaceFault, namespaceOf, newestOf, versionsOf } from './model';

interface ReferenceFieldsProps {
  reference: LibraryReference;
  /** Index among the references; -1 while it is new. */
  at: number;
  references: readonly LibraryReference[];
  installed: readonly LibrarySummary[];
  change: (reference: LibraryReference) => void;
}

/** Version, namespace, how names are used, and the placeholder that the reference is, if it is one. */
export function ReferenceFields({ reference, at, references, installed, change }: ReferenceFieldsProps) {
  const t = useText();
  const fault = namespaceFault(reference, at, references, installed);
  const isPlaceholder = reference.placeholder != null;
  const demanded = libraryOf(reference, installed)?.qualified_only ?? false;
  return (
    <>
      <Checkbox
        checked={isPlaceholder}
        onChecked={(checked) => change({ ...reference, placeholder: checked ? reference.name : null })}
      >
        {t('libraries.asPlaceholder')}
      </Checkbox>
      {isPlaceholder && (
        <>
          <Field
            label={t('libraries.placeholder')}
            error={placeholderFault(reference) ? t('library.namespaceFault') : null}
            hint={t('libraries.placeholderHint')}
          >
            {(attributes) => (
              <TextInput
                {...attributes}
                className="code"
                value={reference.placeholder ?? ''}
                onValue={(placeholder) => change({ ...reference, placeholder })}
              />
            )}
          </Field>
          <Field label={t('libraries.resolution')}>
            {(attributes) => (
              <Select
                {...attributes}
                value={reference.name}
                choices={newestOf(installed).map(({ name }) => ({ value: name, text: name }))}
                onValue={(name) => change({ ...reference, name, version: '*' })}
              />
            )}
          </Field>
        </>
      )}
      <Field label={t('library.version')}>
        {(attributes) => (
          <Select
            {...attributes}
            value={reference.version}
            choices={versionChoices(reference, installed, t('library.newest'))}
            onValue={(version) => change({ ...reference, version })}
          />
        )}
      </Field>
      <Field label={t('library.namespace')} error={fault && t(fault)} hint={t('library.namespaceHint')}>
        {(attributes) => (
          <TextInput
            {...attributes}
            className="code"
            value={reference.namespace}
            placeholder={namespaceOf({ ...reference, namespace: '' }, installed)}
            onValue={(namespace) => change({ ...reference, namespace })}
          />
        )}
      </Field>
      <Checkbox
        checked={demanded || (reference.qualified_only ?? false)}
        disabled={demanded}
        onChecked={(qualified_only) => change({ ...reference, qualified_only })}
      >
        {t(demanded ? 'library.qualifiedOnlyDemanded' : 'library.qualifiedOnly')}
      </Checkbox>
    </>
  );
}

/** A placeholder without a name, or with one that cannot be a namespace. */
export function placeholderFault(reference: LibraryReference): boolean {
  return reference.placeholder != null && !/^[A-Za-z_][A-Za-z0-9_ ]{0,79}$/.test(reference.placeholder);
}

/** Newest, the version that is asked for now, and all that are installed. */
export function versionChoices(reference: LibraryReference, installed: readonly LibrarySummary[], newest: string) {
  const versions = versionsOf(reference.name, installed).map((library) => library.version);
  return [...new Set(['*', reference.version, ...versions])].map((value) => ({
    value,
    text: value === '*' ? newest : value,
  }));
}
