import { useState } from 'react';
import type { Breakpoint, BreakpointOrder } from '@/api/types';
import { useText } from '@/i18n';
import { Checkbox, Field, Select, TextInput } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { openDialog } from '@/ui/dialogs';
import { guard } from '@/ui/notices';
import { useTasks } from '../online/poll';
import { addBreakpoint, changeBreakpoint } from './acts';

type HitMode = NonNullable<BreakpointOrder['hits']>['mode'];
const MODES = ['always', 'equal', 'from', 'every'] as const satisfies readonly NonNullable<HitMode>[];
/** No name of a task; an empty one would show nothing in the field. */
const ANY = '*';

/** Asks what a breakpoint is to do. */
export async function editBreakpoint(runtimeId: string, breakpoint: Breakpoint): Promise<void> {
  const order = await ask(runtimeId, breakpoint.order);
  if (order !== undefined) await guard(() => changeBreakpoint(runtimeId, breakpoint.id, order));
}

/** A breakpoint on the value of a variable. */
export async function newDataBreakpoint(runtimeId: string, expression = ''): Promise<void> {
  const order = await ask(runtimeId, { kind: 'data', expression });
  if (order !== undefined) await guard(() => addBreakpoint(runtimeId, order));
}

function ask(runtimeId: string, order: BreakpointOrder): Promise<BreakpointOrder | undefined> {
  return openDialog<BreakpointOrder>((close) => (
    <BreakpointDialog runtimeId={runtimeId} order={order} onAnswer={close} onClose={() => close(undefined)} />
  ));
}

interface BreakpointDialogProps {
  runtimeId: string;
  order: BreakpointOrder;
  onAnswer: (order: BreakpointOrder) => void;
  onClose: () => void;
}

function BreakpointDialog({ runtimeId, order, onAnswer, onClose }: BreakpointDialogProps) {
  const t = useText();
  const { data: tasks } = useTasks(runtimeId);
  const [expression, setExpression] = useState(order.expression ?? '');
  const [condition, setCondition] = useState(order.condition ?? '');
  const [mode, setMode] = useState<NonNullable<HitMode>>(order.hits?.mode ?? 'always');
  const [count, setCount] = useState(String(order.hits?.count ?? 1));
  const [instance, setInstance] = useState(order.instance ?? '');
  const [task, setTask] = useState(order.task ?? ANY);
  const [log, setLog] = useState(order.log ?? '');
  const [enabled, setEnabled] = useState(order.enabled ?? true);
  const data = order.kind === 'data';
  const counted = /^[1-9]\d{0,11}$/.test(count.trim());
  const wrong =
    (data && expression.trim() === '' ? t('debugger.needsVariable') : null) ??
    (mode !== 'always' && !counted ? t('debugger.needsCount') : null);
  const orNull = (given: string) => given.trim() || null;
  return (
    <FormDialog
      title={t(data ? 'debugger.dataBreakpoint' : 'debugger.breakpoint')}
      action={t('action.apply')}
      disabledReason={wrong}
      onClose={onClose}
      onSubmit={() =>
        onAnswer({
          ...order,
          expression: data ? orNull(expression) : null,
          condition: orNull(condition),
          hits: { mode, count: mode === 'always' ? 1 : Number(count.trim()) },
          instance: data ? null : orNull(instance),
          task: task === ANY ? null : task,
          log: orNull(log),
          enabled,
        })
      }
    >
      {data && (
        <Field label={t('debugger.variable')} hint={t('debugger.variableHint')}>
          {(attributes) => (
            <TextInput
              {...attributes}
              className="code"
              value={expression}
              onValue={setExpression}
              spellCheck={false}
              data-autofocus
            />
          )}
        </Field>
      )}
      <Field label={t('debugger.column.condition')} hint={t('debugger.conditionHint')}>
        {(attributes) => (
          <TextInput
            {...attributes}
            className="code"
            value={condition}
            onValue={setCondition}
            spellCheck={false}
            data-autofocus={!data || undefined}
          />
        )}
      </Field>
      <Field label={t('debugger.hitCount')}>
        {(attributes) => (
          <Select
            {...attributes}
            label={t('debugger.hitCount')}
            value={mode}
            choices={MODES.map((one) => ({ value: one, text: t(`debugger.mode.${one}`) }))}
            onValue={setMode}
          />
        )}
      </Field>
      {mode !== 'always' && (
        <Field label={t('debugger.count')} error={counted ? undefined : t('debugger.needsCount')}>
          {(attributes) => <TextInput {...attributes} value={count} onValue={setCount} inputMode="numeric" />}
        </Field>
      )}
      {!data && (
        <Field label={t('debugger.instance')} hint={t('debugger.instanceHint')}>
          {(attributes) => (
            <TextInput {...attributes} className="code" value={instance} onValue={setInstance} spellCheck={false} />
          )}
        </Field>
      )}
      <Field label={t('debugger.task')}>
        {(attributes) => (
          <Select
            {...attributes}
            label={t('debugger.task')}
            value={task}
            choices={[
              { value: ANY, text: t('debugger.anyTask') },
              ...(tasks ?? []).map(({ name }) => ({ value: name, text: name })),
            ]}
            onValue={setTask}
          />
        )}
      </Field>
      <Field label={t('debugger.log')} hint={t('debugger.logHint')}>
        {(attributes) => <TextInput {...attributes} value={log} onValue={setLog} spellCheck={false} />}
      </Field>
      <Checkbox checked={enabled} onChecked={setEnabled}>
        {t('debugger.enabled')}
      </Checkbox>
    </FormDialog>
  );
}
