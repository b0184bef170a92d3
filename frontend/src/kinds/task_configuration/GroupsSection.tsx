import { Plus, Trash2 } from 'lucide-react';
import { useState } from 'react';
import type { TaskConfigurationData, TaskGroup } from '@/api/types';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import type { Draft } from '@/editors/form/useDraft';
import { listed, useText } from '@/i18n';
import { Button, IconButton } from '@/ui/Button';
import { Select, TextInput } from '@/ui/Field';
import { freeGroupName, groupFault, processorsFrom } from './events';
import styles from './Rows.module.css';

interface GroupsSectionProps {
  draft: Draft<TaskConfigurationData>;
  /** Names of the tasks with the group of each. */
  tasks: readonly { name: string; group: string }[];
  /** Processors of the controller, while logged in. */
  there: readonly number[] | null;
}

const POLICIES: readonly TaskGroup['policy'][] = ['fifo', 'round_robin', 'normal'];

/** Groups of tasks, and the processors that each may use. */
export function GroupsSection({ draft, tasks, there }: GroupsSectionProps) {
  const t = useText();
  const { data } = draft;
  if (data === undefined) return null;
  const change = (groups: TaskGroup[]) => draft.change({ ...data, groups });
  const replace = (at: number, changes: Partial<TaskGroup>) =>
    change(data.groups.map((group, place) => (place === at ? { ...group, ...changes } : group)));
  const disabled = draft.readOnly !== null;
  const members = (name: string) =>
    tasks.filter((task) => task.group.toUpperCase() === name.toUpperCase()).map((task) => task.name);
  const faultOf = (at: number): { tone: 'error' | 'warn'; text: string } | null => {
    const fault = groupFault(data.groups, at);
    if (fault) return { tone: 'error', text: t(fault) };
    const lacking = there === null ? [] : data.groups[at]!.processors.filter((number) => !there.includes(number));
    if (lacking.length === 0) return null;
    const values = { lacking: listed(lacking.map(String)), there: listed((there ?? []).map(String)) };
    return { tone: 'warn', text: t('taskGroup.lacking', values) };
  };
  return (
    <Section
      title={t('taskGroup.title')}
      tools={
        <Button
          icon={Plus}
          disabledReason={draft.readOnly}
          onClick={() => change([...data.groups, { name: freeGroupName(data.groups), processors: [], policy: 'fifo' }])}
        >
          {t('taskGroup.add')}
        </Button>
      }
    >
      <p className={form.note}>{t('taskGroup.text')}</p>
      {data.groups.length > 0 && (
        <table className={styles.rows}>
          <thead>
            <tr>
              <th>{t('taskGroup.name')}</th>
              <th>{t('taskGroup.processors')}</th>
              <th>{t('taskGroup.policy')}</th>
              <th>{t('taskGroup.members')}</th>
              <th aria-label={t('taskGroup.remove')} />
            </tr>
          </thead>
          <tbody>
            {data.groups.map((group, at) => {
              const fault = faultOf(at);
              return [
                <tr key={at}>
                  <td>
                    <TextInput
                      className="code"
                      aria-label={t('taskGroup.nameOf', { number: at + 1 })}
                      disabled={disabled}
                      value={group.name}
                      onValue={(name) => replace(at, { name })}
                    />
                  </td>
                  <td>
                    <ProcessorsInput
                      label={t('taskGroup.processorsOf', { name: group.name })}
                      value={group.processors}
                      disabled={disabled}
                      onValue={(processors) => replace(at, { processors })}
                    />
                  </td>
                  <td>
                    <Select<TaskGroup['policy']>
                      label={t('taskGroup.policyOf', { name: group.name })}
                      disabled={disabled}
                      value={group.policy}
                      choices={POLICIES.map((value) => ({ value, text: t(`taskGroup.policy.${value}`) }))}
                      onValue={(policy) => replace(at, { policy })}
                    />
                  </td>
                  <td className={styles.wide}>{listed(members(group.name)) || '–'}</td>
                  <td>
                    <IconButton
                      icon={Trash2}
                      label={t('taskGroup.removeOf', { name: group.name })}
                      disabledReason={draft.readOnly}
                      onClick={() => change(data.groups.filter((_, place) => place !== at))}
                    />
                  </td>
                </tr>,
                fault && (
                  <tr key={`${String(at)}-fault`}>
                    <td colSpan={5} className={styles.fault} data-tone={fault.tone} role="alert">
                      {fault.text}
                    </td>
                  </tr>
                ),
              ];
            })}
          </tbody>
        </table>
      )}
    </Section>
  );
}

interface ProcessorsInputProps {
  label: string;
  value: readonly number[];
  disabled: boolean;
  onValue: (value: number[]) => void;
}

/** Numbers with commas between; what is typed counts once it is a list, and is put in order when the field is left. */
function ProcessorsInput({ label, value, disabled, onValue }: ProcessorsInputProps) {
  const t = useText();
  const [typed, setTyped] = useState<string | null>(null);
  const faulty = typed !== null && processorsFrom(typed) === null;
  return (
    <TextInput
      className="code"
      aria-label={label}
      aria-invalid={faulty || undefined}
      title={faulty ? t('taskGroup.processorsFault') : undefined}
      placeholder={t('taskGroup.automatic')}
      disabled={disabled}
      value={typed ?? value.join(', ')}
      onValue={(text) => {
        setTyped(text);
        const numbers = processorsFrom(text);
        if (numbers !== null) onValue(numbers);
      }}
      onBlur={() => setTyped(null)}
    />
  );
}
