import { ofKind } from '@/api/objects';
import { useObjects } from '@/api/queries';
import type { TaskData } from '@/api/types';
import { useText } from '@/i18n';
import { SOFT_PLC, SOFT_PLC_EXTERNAL_EVENTS, SOFT_PLC_KINDS } from '@/iec/softPlc';
import { objectIcon } from '@/project/kinds';
import type { EditorProps } from '@/project/editorProps';
import { Checkbox, Field, Select, TextInput } from '@/ui/Field';
import { FormPage, Section } from '@/editors/form/FormPage';
import styles from '@/editors/form/Form.module.css';
import { useDraft } from '@/editors/form/useDraft';
import { EventField } from './EventField';
import { callablePrograms, canStore, externalEvent, NO_GROUP, sameName, taskFaults } from './model';
import { ProgramList } from './ProgramList';
import { TimeField } from './TimeField';
import { useGroups } from './useGroups';

const TaskIcon = objectIcon('task');

/** Priority, type, watchdog and the programs of one task. */
export default function TaskEditor({ panelId, projectId, objectId }: EditorProps) {
  const t = useText();
  const draft = useDraft(panelId, projectId, objectId, ofKind('task'), canStore);
  const { data: objects } = useObjects(projectId);
  const disabled = draft.readOnly !== null;
  const groups = useGroups(projectId, draft.object?.parent_id ?? null);
  return (
    <FormPage draft={draft}>
      {(task) => {
        const faults = taskFaults(task);
        const fault = (key: keyof typeof faults) => (faults[key] ? t(faults[key], SOFT_PLC) : null);
        const change = (changes: Partial<TaskData>) => draft.change({ ...task, ...changes });
        const watchdog = (changes: Partial<TaskData['watchdog']>) =>
          change({ watchdog: { ...task.watchdog, ...changes } });
        return (
          <>
            <h1 className={styles.title}>
              <TaskIcon size={20} />
              {draft.object?.name}
            </h1>
            <Section title={t('task.configuration')}>
              <div className={styles.fields}>
                <Field row label={t('task.priority')} hint={t('task.priorityHint', SOFT_PLC)} error={fault('priority')}>
                  {(attributes) => (
                    <TextInput
                      {...attributes}
                      className={styles.narrow}
                      type="number"
                      min={SOFT_PLC.highestPriority}
                      max={SOFT_PLC.lowestPriority}
                      disabled={disabled}
                      value={Number.isNaN(task.priority) ? '' : task.priority}
                      onValue={(value) => change({ priority: value === '' ? Number.NaN : Number(value) })}
                    />
                  )}
                </Field>
                <Field row label={t('task.type')} hint={t(`taskType.${task.type}Text`)}>
                  {(attributes) => (
                    <Select<TaskData['type']>
                      {...attributes}
                      disabled={disabled}
                      value={task.type}
                      choices={SOFT_PLC_KINDS.map((type) => ({ value: type, text: t(`taskType.${type}`) }))}
                      onValue={(type) => change({ type })}
                    />
                  )}
                </Field>
                {task.type === 'cyclic' && (
                  <TimeField
                    label={t('task.interval')}
                    value={task.interval}
                    error={fault('interval')}
                    disabled={disabled}
                    onValue={(interval) => change({ interval })}
                  />
                )}
                {(task.type === 'event' || task.type === 'status') && (
                  <EventField
                    projectId={projectId}
                    object={draft.object}
                    value={task.event}
                    error={fault('event')}
                    disabled={disabled}
                    onValue={(event) => change({ event })}
                  />
                )}
                {task.type === 'external' && (
                  <Field row label={t('task.event')} hint={externalHint(task.event, t)} error={fault('event')}>
                    {(attributes) => (
                      <Select
                        {...attributes}
                        disabled={disabled}
                        value={externalEvent(task.event)}
                        choices={SOFT_PLC_EXTERNAL_EVENTS.map((value) => ({ value, text: value }))}
                        onValue={(event) => change({ event })}
                      />
                    )}
                  </Field>
                )}
                {(groups.length > 0 || task.group !== '') && (
                  <Field
                    row
                    label={t('task.group')}
                    hint={t('task.groupHint')}
                    error={
                      task.group === '' || groups.some((one) => sameName(one, task.group))
                        ? null
                        : t('task.groupFault', { name: task.group })
                    }
                  >
                    {(attributes) => (
                      <Select
                        {...attributes}
                        disabled={disabled}
                        value={groups.find((one) => sameName(one, task.group)) ?? (task.group === '' ? NO_GROUP : null)}
                        choices={[
                          { value: NO_GROUP, text: t('task.noGroup') },
                          ...groups.map((value) => ({ value, text: value })),
                        ]}
                        onValue={(group) => change({ group: group === NO_GROUP ? '' : group })}
                      />
                    )}
                  </Field>
                )}
              </div>
            </Section>
            <Section title={t('task.watchdog')}>
              <div className={styles.fields}>
                <Checkbox
                  checked={task.watchdog.enabled}
                  disabled={disabled}
                  onChecked={(enabled) => watchdog({ enabled })}
                >
                  {t('task.watchdogEnable')}
                </Checkbox>
                {task.watchdog.enabled && (
                  <>
                    {task.type === 'cyclic' && (
                      <Checkbox
                        checked={task.watchdog.percent !== null}
                        disabled={disabled}
                        onChecked={(relative) => watchdog({ percent: relative ? 100 : null })}
                      >
                        {t('task.watchdogRelative')}
                      </Checkbox>
                    )}
                    {task.type === 'cyclic' && task.watchdog.percent !== null ? (
                      <Field row label={t('task.watchdogPercent')} error={fault('watchdogPercent')}>
                        {(attributes) => (
                          <TextInput
                            {...attributes}
                            className={styles.narrow}
                            type="number"
                            min={1}
                            max={SOFT_PLC.mostPercent}
                            disabled={disabled}
                            value={Number.isNaN(task.watchdog.percent) ? '' : (task.watchdog.percent ?? '')}
                            onValue={(value) => watchdog({ percent: value === '' ? Number.NaN : Number(value) })}
                          />
                        )}
                      </Field>
                    ) : (
                      <TimeField
                        label={t('task.watchdogTime')}
                        value={task.watchdog.time}
                        error={fault('watchdogTime')}
                        disabled={disabled}
                        onValue={(time) => watchdog({ time })}
                      />
                    )}
                    <Field
                      row
                      label={t('task.sensitivity')}
                      hint={t('task.sensitivityHint')}
                      error={fault('sensitivity')}
                    >
                      {(attributes) => (
                        <TextInput
                          {...attributes}
                          className={styles.narrow}
                          type="number"
                          min={0}
                          max={SOFT_PLC.mostSensitivity}
                          disabled={disabled}
                          value={Number.isNaN(task.watchdog.sensitivity) ? '' : task.watchdog.sensitivity}
                          onValue={(value) => watchdog({ sensitivity: value === '' ? Number.NaN : Number(value) })}
                        />
                      )}
                    </Field>
                  </>
                )}
              </div>
            </Section>
            <Section title={t('task.programs')}>
              <ProgramList
                pous={task.pous}
                programs={callablePrograms(objects ?? [], objectId)}
                readOnly={draft.readOnly}
                onChange={(pous) => change({ pous })}
              />
            </Section>
          </>
        );
      }}
    </FormPage>
  );
}

/** When an external event happens; nothing for one that the controller does not have. */
function externalHint(event: string, t: ReturnType<typeof useText>): string | undefined {
  const known = externalEvent(event);
  return known === null ? undefined : t(`task.external.${known}`);
}
