import { useState } from 'react';
import { NumberCell } from '@/editors/form/NumberField';
import { useText } from '@/i18n';
import { FormDialog } from '@/ui/FormDialog';
import { useRefusal } from '@/ui/useRefusal';
import styles from './Cnc.module.css';
import { FARTHEST, saveProperties, type CncProgramData } from './properties';
import { usedVariables } from './variables';

interface VariablesDialogProps {
  projectId: string;
  objectId: string;
  data: CncProgramData;
  lines: readonly string[];
  close: () => void;
}

/** What the variables of the program count as where no controller runs (CNC-17, CNC-80). */
export function VariablesDialog({ projectId, objectId, data, lines, close }: VariablesDialogProps) {
  const t = useText();
  const [refused, ask] = useRefusal();
  const [values, setValues] = useState(() => offlineValues(data, lines));
  const isValue = (value: number) => Math.abs(value) <= FARTHEST;
  const wrong = values.some(({ value }) => !isValue(value));
  return (
    <FormDialog
      title={t('cnc.offlineValues')}
      description={t('cnc.offlineText')}
      action={t('cnc.takeValues')}
      disabledReason={values.length === 0 ? t('cnc.noVariables') : wrong ? t('cnc.faultNumber') : null}
      onClose={close}
      onSubmit={() =>
        void ask(async () => {
          await saveProperties(projectId, objectId, { offline_values: values });
          close();
        })
      }
    >
      {refused && <p role="alert">{refused}</p>}
      {values.length === 0 && <p className={styles.muted}>{t('cnc.noVariables')}</p>}
      <table className={styles.values}>
        <tbody>
          {values.map(({ name, value }, row) => (
            <tr key={name}>
              <th scope="row" className="code">
                {name}
              </th>
              <td>
                <NumberCell
                  label={t('cnc.valueOf', { name })}
                  value={value}
                  invalid={!isValue(value)}
                  onValue={(next) => setValues(values.map((one, at) => (at === row ? { name, value: next } : one)))}
                />
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </FormDialog>
  );
}

/** Those that the program uses, with the values they have, 0 for new ones. */
export function offlineValues(
  data: Pick<CncProgramData, 'offline_values'>,
  lines: readonly string[],
): CncProgramData['offline_values'] {
  const known = new Map(data.offline_values.map(({ name, value }) => [name.toLowerCase(), value]));
  return usedVariables(lines).map((name) => ({ name, value: known.get(name.toLowerCase()) ?? 0 }));
}
