import { useState } from 'react';
import { useText } from '@/i18n';
import { Field, Select, TextInput } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { EVENT_TEXTS, EVENTS, isName, type SystemEventName } from './events';

interface SystemEventDialogProps {
  /** Events that have a function already. */
  taken: readonly SystemEventName[];
  /** Names of the functions and programs that can be called. */
  functions: readonly string[];
  close: (chosen?: { event: SystemEventName; function: string }) => void;
}

/** Couples an event to a function; one that does not exist yet will be made. */
export function SystemEventDialog({ taken, functions, close }: SystemEventDialogProps) {
  const t = useText();
  const free = EVENTS.filter((event) => !taken.includes(event));
  const [event, setEvent] = useState<SystemEventName>(free.includes('StartDone') ? 'StartDone' : free[0]!);
  const [typed, setTyped] = useState<string | null>(null);
  const name = typed ?? `On${event}`;
  const exists = functions.some((one) => one.toUpperCase() === name.toUpperCase());
  const fault = isName(name) ? null : t('systemEvent.functionFault');
  return (
    <FormDialog
      title={t('systemEvent.add')}
      width={460}
      onClose={() => close()}
      onSubmit={() => close({ event, function: name })}
      action={t('systemEvent.addAction')}
      disabledReason={fault}
    >
      <Field label={t('systemEvent.event')} hint={t(EVENT_TEXTS[event])}>
        {(attributes) => (
          <Select<SystemEventName>
            {...attributes}
            value={event}
            choices={free.map((value) => ({ value, text: value }))}
            onValue={setEvent}
          />
        )}
      </Field>
      <Field
        label={t('systemEvent.function')}
        error={fault}
        hint={t(exists ? 'systemEvent.existing' : 'systemEvent.created')}
      >
        {(attributes) => (
          <>
            <TextInput
              {...attributes}
              data-autofocus
              className="code"
              list="system-event-functions"
              value={name}
              onValue={setTyped}
            />
            <datalist id="system-event-functions">
              {functions.map((one) => (
                <option key={one} value={one} />
              ))}
            </datalist>
          </>
        )}
      </Field>
    </FormDialog>
  );
}
