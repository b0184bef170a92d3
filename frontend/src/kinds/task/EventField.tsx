import { Ellipsis } from 'lucide-react';
import type { ObjectSummary } from '@/api/types';
import { InputAssistant } from '@/editors/assistant/InputAssistant';
import styles from '@/editors/form/Form.module.css';
import { useText } from '@/i18n';
import { IconButton } from '@/ui/Button';
import { openDialog } from '@/ui/dialogs';
import { Field, TextInput } from '@/ui/Field';

interface EventFieldProps {
  projectId: string;
  object: ObjectSummary | undefined;
  value: string;
  error: string | null;
  disabled: boolean;
  onValue: (value: string) => void;
}

/** The BOOL variable that a task waits for: typed, or chosen with F2 (TASK-18). */
export function EventField({ projectId, object, value, error, disabled, onValue }: EventFieldProps) {
  const t = useText();
  const choose = async () => {
    const chosen = await openDialog<string>((close) => (
      <InputAssistant projectId={projectId} object={object} category="variables" close={close} />
    ));
    if (chosen !== undefined) onValue(chosen);
  };
  return (
    <Field row label={t('task.event')} error={error}>
      {(attributes) => (
        <div className={styles.inline}>
          <TextInput
            {...attributes}
            className="code"
            disabled={disabled}
            value={value}
            placeholder={t('task.eventExample')}
            onValue={onValue}
            onKeyDown={(event) => {
              if (event.key !== 'F2' || disabled) return;
              event.preventDefault();
              event.stopPropagation();
              void choose();
            }}
          />
          <IconButton
            icon={Ellipsis}
            label={t('task.chooseEvent')}
            shortcut="F2"
            disabledReason={disabled ? t('task.locked') : null}
            onClick={() => void choose()}
          />
        </div>
      )}
    </Field>
  );
}
