import { useState } from 'react';
import { timeLiteral } from '@/iec/duration';
import { useText } from '@/i18n';
import { Field, TextInput } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { notifyError } from '@/ui/notices';
import type { LongTermOrder } from './online';

interface LongTermDialogProps {
  title: string;
  begin: (order: LongTermOrder) => Promise<void>;
  close: (answer?: true) => void;
}

/** Whole seconds of a TIME literal; null where nothing is typed, NaN where it is none. */
function seconds(text: string): number | null {
  if (text.trim() === '') return null;
  const ns = timeLiteral(text);
  return ns === null || ns < 1e9 ? NaN : Math.round(ns / 1e9);
}

function mebibytes(text: string): number | null {
  if (text.trim() === '') return null;
  return /^\s*[1-9]\d{0,6}\s*$/.test(text) && Number(text) <= 2 ** 20 ? Number(text) : NaN;
}

/** Every sample from now on: until when, and how many of them are kept. */
export function LongTermDialog({ title: usual, begin, close }: LongTermDialogProps) {
  const t = useText();
  const [title, setTitle] = useState(usual);
  const [end, setEnd] = useState('');
  const [age, setAge] = useState('');
  const [size, setSize] = useState('');
  const order: LongTermOrder = {
    title: title.trim(),
    seconds: seconds(end),
    keep_seconds: seconds(age),
    keep_mib: mebibytes(size),
  };
  const fault = (value: number | null, text: string) => (Number.isNaN(value) ? text : undefined);
  const faults = {
    title: order.title === '' ? t('trace.fault.name') : undefined,
    end: fault(order.seconds, t('trace.fault.timeFromSecond')),
    age: fault(order.keep_seconds, t('trace.fault.timeFromSecond')),
    size: fault(order.keep_mib, t('trace.fault.mebibytes')),
  };
  const start = async () => {
    try {
      await begin(order);
      close(true);
    } catch (error) {
      notifyError(error);
    }
  };
  return (
    <FormDialog
      title={t('trace.longTermTitle')}
      description={t('trace.longTermText')}
      action={t('trace.longTermBegin')}
      disabledReason={Object.values(faults).find((one) => one !== undefined) ?? null}
      onClose={() => close()}
      onSubmit={() => void start()}
    >
      <Field row label={t('trace.title')} error={faults.title}>
        {(attributes) => <TextInput {...attributes} value={title} onValue={setTitle} maxLength={200} />}
      </Field>
      <Field row label={t('trace.endAfter')} hint={t('trace.endAfterHint')} error={faults.end}>
        {(attributes) => <TextInput {...attributes} value={end} onValue={setEnd} placeholder="T#8h" />}
      </Field>
      <Field row label={t('trace.keepAge')} hint={t('trace.keepHint')} error={faults.age}>
        {(attributes) => <TextInput {...attributes} value={age} onValue={setAge} placeholder="T#1d" />}
      </Field>
      <Field row label={t('trace.keepSize')} hint={t('trace.keepHint')} error={faults.size}>
        {(attributes) => (
          <TextInput {...attributes} value={size} onValue={setSize} placeholder="500" inputMode="numeric" />
        )}
      </Field>
    </FormDialog>
  );
}
