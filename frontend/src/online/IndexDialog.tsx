import { useState } from 'react';
import { useText } from '@/i18n';
import { Field, TextInput } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { guard } from '@/ui/notices';
import type { Located } from './indexJump';

interface IndexDialogProps {
  path: string;
  /** Its bounds, such as `0..9, 0..3`. */
  bounds: string;
  find: (text: string) => Promise<Located>;
  close: (found?: Located & { ok: true }) => void;
}

/** Asks for the indices of an element of an array. */
export function IndexDialog({ path, bounds, find, close }: IndexDialogProps) {
  const t = useText();
  const [text, setText] = useState('');
  const [fault, setFault] = useState<string | null>(null);
  const submit = async () => {
    const found = await find(text);
    if (found.ok) close(found);
    else setFault(t(found.reason, found.values));
  };
  return (
    <FormDialog
      title={t('online.goToIndex')}
      description={<span className="code">{path}</span>}
      action={t('online.index.go')}
      disabledReason={text.trim() === '' ? t('online.index.empty') : null}
      width={360}
      onClose={() => close()}
      onSubmit={() => void guard(submit)}
    >
      <Field label={t('online.index')} hint={t('online.index.bounds', { bounds })} error={fault}>
        {(attributes) => (
          <TextInput
            {...attributes}
            data-autofocus
            className="code"
            value={text}
            onValue={(next) => {
              setText(next);
              setFault(null);
            }}
          />
        )}
      </Field>
    </FormDialog>
  );
}
