import { Plus, SquareArrowOutUpRight, Trash2, TriangleAlert, Zap } from 'lucide-react';
import { useObjects } from '@/api/queries';
import type { SystemEventCall, TaskConfigurationData } from '@/api/types';
import { FormPage, Section } from '@/editors/form/FormPage';
import type { Draft } from '@/editors/form/useDraft';
import { useText } from '@/i18n';
import { useLiveValue, useWatched } from '@/online/useLive';
import { applicationOf } from '@/project/tree';
import { Button, IconButton } from '@/ui/Button';
import { openDialog } from '@/ui/dialogs';
import { Empty } from '@/ui/Empty';
import { Checkbox, TextInput } from '@/ui/Field';
import { guard } from '@/ui/notices';
import { Tooltip } from '@/ui/Tooltip';
import { openObject } from '@/workbench/docking/dock';
import { createObject } from '@/workbench/tree/acts';
import { callableAtEvents, counterOf, EVENT_TEXTS, EVENTS, type SystemEventName } from './events';
import styles from './Rows.module.css';
import { SystemEventDialog } from './SystemEventDialog';

interface SystemEventsPageProps {
  draft: Draft<TaskConfigurationData>;
  projectId: string;
  objectId: string;
  /** Runtime that the application is logged in to; null: none. */
  runtimeId: string | null;
}

/** Functions that are called when something happens to the application (TASK-05); online with a counter of the calls. */
export function SystemEventsPage({ draft, projectId, objectId, runtimeId }: SystemEventsPageProps) {
  const t = useText();
  const { data: objects } = useObjects(projectId);
  const functions = callableAtEvents(objects ?? [], objectId);
  const known = (name: string) => functions.find((one) => one.name.toUpperCase() === name.toUpperCase());
  useWatched(runtimeId, draft.data?.system_events.map((call) => counterOf(call.event)) ?? []);
  return (
    <FormPage draft={draft} wide>
      {(data) => {
        const change = (system_events: SystemEventCall[]) => draft.change({ ...data, system_events });
        const replace = (at: number, changes: Partial<SystemEventCall>) =>
          change(data.system_events.map((call, place) => (place === at ? { ...call, ...changes } : call)));
        const taken = data.system_events.map((call) => call.event);
        const add = () =>
          guard(async () => {
            const chosen = await openDialog<{ event: SystemEventName; function: string }>((close) => (
              <SystemEventDialog taken={taken} functions={functions.map((one) => one.name)} close={close} />
            ));
            if (chosen === undefined) return;
            const parent = objects && applicationOf(objects, objectId);
            if (!known(chosen.function) && parent)
              await createObject(projectId, {
                kind: 'pou',
                subkind: 'function',
                name: chosen.function,
                parent_id: parent.id,
              });
            change([...data.system_events, { ...chosen, description: '', active: true }]);
          });
        const full = taken.length === EVENTS.length ? t('systemEvent.allTaken') : null;
        return (
          <Section
            title={t('taskConfiguration.systemEvents')}
            tools={
              <Button icon={Plus} disabledReason={draft.readOnly ?? full} onClick={() => void add()}>
                {t('systemEvent.add')}
              </Button>
            }
          >
            {data.system_events.length === 0 ? (
              <Empty icon={Zap} title={t('systemEvent.none')} text={t('systemEvent.noneText')} />
            ) : (
              <table className={styles.rows}>
                <thead>
                  <tr>
                    <th>{t('systemEvent.event')}</th>
                    <th>{t('systemEvent.function')}</th>
                    <th>{t('systemEvent.description')}</th>
                    <th>{t('systemEvent.active')}</th>
                    {runtimeId !== null && <th className={styles.count}>{t('systemEvent.calls')}</th>}
                    <th aria-label={t('systemEvent.remove')} />
                  </tr>
                </thead>
                <tbody>
                  {data.system_events.map((call, at) => {
                    const target = known(call.function);
                    return (
                      <tr key={call.event}>
                        <td>
                          <Tooltip text={t(EVENT_TEXTS[call.event])}>
                            <span>{call.event}</span>
                          </Tooltip>
                        </td>
                        <td>
                          <div className={styles.cell}>
                            <TextInput
                              className="code"
                              aria-label={t('systemEvent.functionOf', { event: call.event })}
                              disabled={draft.readOnly !== null}
                              value={call.function}
                              onValue={(text) => replace(at, { function: text.trim() })}
                            />
                            {!target && (
                              <Tooltip text={t('systemEvent.unknown')}>
                                <TriangleAlert size={14} color="var(--warn)" />
                              </Tooltip>
                            )}
                            <IconButton
                              icon={SquareArrowOutUpRight}
                              label={t('systemEvent.open', { name: call.function })}
                              disabledReason={target ? null : t('systemEvent.unknown')}
                              onClick={() => target && openObject(target.id, target.name)}
                            />
                          </div>
                        </td>
                        <td className={styles.wide}>
                          <TextInput
                            aria-label={t('systemEvent.descriptionOf', { event: call.event })}
                            placeholder={t(EVENT_TEXTS[call.event])}
                            disabled={draft.readOnly !== null}
                            value={call.description}
                            onValue={(description) => replace(at, { description })}
                          />
                        </td>
                        <td>
                          <Checkbox
                            label={t('systemEvent.activeOf', { event: call.event })}
                            checked={call.active}
                            disabled={draft.readOnly !== null}
                            onChecked={(active) => replace(at, { active })}
                          />
                        </td>
                        {runtimeId !== null && (
                          <td className={styles.count}>
                            {call.active && <CallCount runtimeId={runtimeId} event={call.event} />}
                          </td>
                        )}
                        <td>
                          <IconButton
                            icon={Trash2}
                            label={t('systemEvent.removeOf', { event: call.event })}
                            disabledReason={draft.readOnly}
                            onClick={() => change(data.system_events.filter((_, place) => place !== at))}
                          />
                        </td>
                      </tr>
                    );
                  })}
                </tbody>
              </table>
            )}
          </Section>
        );
      }}
    </FormPage>
  );
}

function CallCount({ runtimeId, event }: { runtimeId: string; event: SystemEventName }) {
  const live = useLiveValue(runtimeId, counterOf(event));
  return <span className="code">{live?.value == null ? '–' : String(live.value)}</span>;
}
