import type { Schemas } from '@/api/types';
import { Section } from '@/editors/form/FormPage';
import { useText } from '@/i18n';
import { Field, Select } from '@/ui/Field';

type SourceDownload = NonNullable<Schemas['ApplicationData']['source_download']>;
const TIMES = ['never', 'on_demand', 'prompt', 'download'] as const satisfies readonly SourceDownload[];

interface SourceFieldsProps {
  /** Undefined: as it is usual. */
  value: SourceDownload | undefined;
  disabled: boolean;
  onChange: (value: SourceDownload) => void;
}

/** When the source of the project goes into the controller. */
export function SourceFields({ value = 'on_demand', disabled, onChange }: SourceFieldsProps) {
  const t = useText();
  return (
    <Section title={t('application.source')}>
      <Field label={t('application.sourceWhen')} hint={t(`application.source.${value}.hint`)}>
        {(attributes) => (
          <Select
            {...attributes}
            value={value}
            disabled={disabled}
            choices={TIMES.map((time) => ({ value: time, text: t(`application.source.${time}`) }))}
            onValue={onChange}
          />
        )}
      </Field>
    </Section>
  );
}
