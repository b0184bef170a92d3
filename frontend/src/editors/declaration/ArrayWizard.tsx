import { useState } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import { Button } from '@/ui/Button';
import { FormDialog } from '@/ui/FormDialog';
import { Field, TextInput } from '@/ui/Field';
import { InputAssistant } from '../assistant/InputAssistant';
import styles from './Dialogs.module.css';
import { formatArrayType, parseArrayType, type ArrayDimension } from '@/iec/declaration/types';

interface ArrayWizardProps {
  projectId: string;
  object: ObjectSummary;
  type: string;
  close: (type?: string) => void;
}

const NONE: ArrayDimension = { low: '', high: '' };
const BOUND = /^-?\d+$|^[A-Za-z_][\w.]*$/;

/** Builds `ARRAY [..] OF type` with up to three dimensions (DECL-27). */
export function ArrayWizard({ projectId, object, type, close }: ArrayWizardProps) {
  const t = useText();
  const present = parseArrayType(type);
  const [base, setBase] = useState(present?.element ?? (type || 'INT'));
  const [bounds, setBounds] = useState<readonly ArrayDimension[]>(() => {
    const start = present?.dimensions ?? [{ low: '0', high: '9' }];
    return [start[0] ?? NONE, start[1] ?? NONE, start[2] ?? NONE];
  });
  const used = bounds.filter((d) => d.low !== '' || d.high !== '');
  const wrong = used.find((d) => !BOUND.test(d.low) || !BOUND.test(d.high) || Number(d.high) < Number(d.low));
  const gap = bounds.some(
    (d, i) => (d.low !== '' || d.high !== '') && bounds.slice(0, i).some((e) => e.low === '' && e.high === ''),
  );
  const reason =
    base.trim() === ''
      ? t('decl.typeNeeded')
      : used.length === 0 || wrong !== undefined || gap
        ? t('decl.badBounds')
        : null;
  const result = formatArrayType({ dimensions: used, element: base.trim() });
  const change = (index: number, part: keyof ArrayDimension, value: string) =>
    setBounds(bounds.map((d, i) => (i === index ? { ...d, [part]: value.trim() } : d)));

  return (
    <FormDialog
      title={t('decl.arrayWizard')}
      width={460}
      onClose={() => close()}
      onSubmit={() => close(result)}
      action={t('st.ok')}
      disabledReason={reason}
    >
      <div className={styles.stack}>
        <div className={styles.dimensions}>
          {bounds.map((dimension, index) => (
            <Dimension
              key={index}
              label={t('decl.dimension', { number: index + 1 })}
              dimension={dimension}
              focus={index === 0}
              onChange={(part, value) => change(index, part, value)}
            />
          ))}
        </div>
        <Field label={t('decl.baseType')}>
          {(attributes) => (
            <div className={styles.withButton}>
              <TextInput {...attributes} value={base} onValue={setBase} />
              <Button
                onClick={() =>
                  void openDialog<string>((done) => (
                    <InputAssistant projectId={projectId} object={object} category="types" close={done} />
                  )).then((chosen) => chosen !== undefined && setBase(chosen))
                }
              >
                {t('decl.browse')}
              </Button>
            </div>
          )}
        </Field>
        <div className={styles.preview}>{result}</div>
      </div>
    </FormDialog>
  );
}

interface DimensionProps {
  label: string;
  dimension: ArrayDimension;
  focus: boolean;
  onChange: (part: keyof ArrayDimension, value: string) => void;
}

function Dimension({ label, dimension, focus, onChange }: DimensionProps) {
  const t = useText();
  return (
    <>
      <span>{label}</span>
      <TextInput
        aria-label={`${label}, ${t('decl.lowerBound')}`}
        placeholder={t('decl.lowerBound')}
        value={dimension.low}
        onValue={(value) => onChange('low', value)}
        data-autofocus={focus || undefined}
      />
      <span>..</span>
      <TextInput
        aria-label={`${label}, ${t('decl.upperBound')}`}
        placeholder={t('decl.upperBound')}
        value={dimension.high}
        onValue={(value) => onChange('high', value)}
      />
      <span />
    </>
  );
}
