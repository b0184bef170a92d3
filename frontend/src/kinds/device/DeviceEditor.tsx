import { useQuery } from '@tanstack/react-query';
import { ofKind } from '@/api/objects';
import { runtimesQuery } from '@/api/queries';
import { useText } from '@/i18n';
import { objectIcon } from '@/project/kinds';
import type { EditorProps } from '@/project/editorProps';
import { Checkbox, Field, TextArea } from '@/ui/Field';
import { FormPage, Section } from '@/editors/form/FormPage';
import styles from '@/editors/form/Form.module.css';
import { useDraft } from '@/editors/form/useDraft';
import { RuntimeList } from './RuntimeList';

const POLL_MS = 2000;
const DeviceIcon = objectIcon('device');

/** Communication settings of a device: which runtime it stands for, its state, simulation. */
export default function DeviceEditor({ panelId, projectId, objectId, visible }: EditorProps) {
  const t = useText();
  const draft = useDraft(panelId, projectId, objectId, ofKind('device'), () => true);
  const runtimes = useQuery({ ...runtimesQuery, refetchInterval: visible ? POLL_MS : false });
  const disabled = draft.readOnly !== null;
  return (
    <FormPage draft={draft}>
      {(device) => (
        <>
          <h1 className={styles.title}>
            <DeviceIcon size={20} />
            {draft.object?.name}
            <span className={styles.note}>{device.device_type}</span>
          </h1>
          <Section title={t('device.communication')}>
            <div>
              <Checkbox
                checked={device.simulated}
                disabled={disabled}
                onChecked={(simulated) => draft.change({ ...device, simulated })}
              >
                {t('device.simulated')}
              </Checkbox>
              <p className={styles.note}>{t('device.simulatedText')}</p>
            </div>
            <RuntimeList
              runtimes={runtimes.data}
              error={runtimes.error}
              chosen={device.simulated ? 'local' : device.runtime_id}
              readOnly={draft.readOnly ?? (device.simulated ? t('device.inSimulation') : null)}
              onChoose={(runtime_id) => draft.change({ ...device, runtime_id })}
            />
          </Section>
          <Section title={t('device.information')}>
            <Field label={t('project.description')}>
              {(attributes) => (
                <TextArea
                  {...attributes}
                  disabled={disabled}
                  value={device.description}
                  onValue={(description) => draft.change({ ...device, description })}
                />
              )}
            </Field>
          </Section>
        </>
      )}
    </FormPage>
  );
}
