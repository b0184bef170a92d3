import { useText } from '@/i18n';
import { Field, TextArea, TextInput } from '@/ui/Field';

interface ProjectFieldsProps {
  name: string;
  description: string;
  readOnly: boolean;
  onName: (name: string) => void;
  onDescription: (description: string) => void;
}

/** Name and description of a project. */
export function ProjectFields({ name, description, readOnly, onName, onDescription }: ProjectFieldsProps) {
  const t = useText();
  return (
    <>
      <Field label={t('project.name')} error={name.trim() === '' ? t('name.empty') : null}>
        {(attributes) => <TextInput {...attributes} value={name} onValue={onName} readOnly={readOnly} />}
      </Field>
      <Field label={t('project.description')}>
        {(attributes) => <TextArea {...attributes} value={description} readOnly={readOnly} onValue={onDescription} />}
      </Field>
    </>
  );
}
