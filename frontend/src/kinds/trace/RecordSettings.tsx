import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { applicationOf } from '@/project/tree';
import { Button } from '@/ui/Button';
import { Checkbox, Field, Select, TextArea } from '@/ui/Field';
import { TimeAxisFields, ValueAxisFields } from './AppearanceFields';
import { EDGES, LIMITS, USUAL_APPEARANCE, type Appearance, type TraceData, type TraceRecord } from './configuration';
import { SettingChoice, SettingColor, SettingNumber, SettingText, type FieldContext } from './fields';
import styles from './Trace.module.css';

/** What stands for "the first task". */
const FIRST = ' ';

interface TraceSettingsProps {
  data: TraceData;
  context: FieldContext;
  onData: (data: TraceData) => void;
}

/** The settings of all records (TRC-10 to TRC-12). */
export function TraceSettings({ data, context, onData }: TraceSettingsProps) {
  const t = useText();
  return (
    <>
      <h3>{t('trace.allRecords')}</h3>
      <SettingNumber
        label={t('trace.refreshRate')}
        field="refresh_rate"
        unit="ms"
        value={data.refresh_rate}
        context={context}
        hint={t('trace.from', { least: LIMITS.refresh_rate[0], most: LIMITS.refresh_rate[1] })}
        onValue={(refresh_rate) => onData({ ...data, refresh_rate })}
      />
      <SettingNumber
        label={t('trace.points')}
        field="points"
        value={data.points}
        context={context}
        hint={t('trace.pointsHint')}
        onValue={(points) => onData({ ...data, points })}
      />
      <Checkbox
        checked={data.stacked}
        disabled={context.disabled}
        onChecked={(stacked) => onData({ ...data, stacked })}
      >
        {t('trace.stacked')}
      </Checkbox>
    </>
  );
}

interface RecordSettingsProps {
  record: TraceRecord;
  context: FieldContext;
  onRecord: (change: Partial<TraceRecord>) => void;
  /** Kept for new records and variables (TRC-13). */
  onUsual: (appearance: Appearance) => void;
}

/** A record: task, trigger, condition, buffer (TRC-20 to TRC-28), and its appearance (TRC-31). */
export function RecordSettings({ record, context, onRecord, onUsual }: RecordSettingsProps) {
  const t = useText();
  const { data: objects } = useObjects(context.projectId);
  const application = objects && context.object ? applicationOf(objects, context.object.id) : undefined;
  const tasks = (objects ?? []).filter(
    (one) => one.kind === 'task' && applicationOf(objects ?? [], one.id)?.id === application?.id,
  );
  const { trigger, appearance } = record;
  const setTrigger = (change: Partial<TraceRecord['trigger']>) => onRecord({ trigger: { ...trigger, ...change } });
  const setAppearance = (change: Partial<Appearance>) => onRecord({ appearance: { ...appearance, ...change } });
  const names = tasks.map(({ name }) => name);
  const listed = record.task === '' || names.includes(record.task) ? names : [...names, record.task];
  return (
    <>
      <h3>{t('trace.record')}</h3>
      <SettingText
        label={t('trace.recordName')}
        field="name"
        value={record.name}
        context={context}
        onValue={(name) => onRecord({ name })}
      />
      <Field row label={t('trace.task')}>
        {(attributes) => (
          <Select
            {...attributes}
            disabled={context.disabled}
            value={record.task === '' ? FIRST : record.task}
            choices={[{ value: FIRST, text: t('trace.firstTask') }, ...listed.map((value) => ({ value, text: value }))]}
            onValue={(task) => onRecord({ task: task === FIRST ? '' : task })}
          />
        )}
      </Field>
      <SettingNumber
        label={t('trace.every')}
        field="every"
        value={record.every}
        context={context}
        onValue={(every) => onRecord({ every })}
      />
      <SettingText
        label={t('trace.condition')}
        field="condition"
        value={record.condition}
        context={context}
        hint={t('trace.conditionHint')}
        assisted
        code
        onValue={(condition) => onRecord({ condition })}
      />
      <SettingNumber
        label={t('trace.buffer')}
        field="buffer"
        value={record.buffer}
        context={context}
        hint={t('trace.bufferHint')}
        onValue={(buffer) => onRecord({ buffer })}
      />
      <Field row label={t('trace.comment')}>
        {(attributes) => (
          <TextArea
            {...attributes}
            rows={2}
            disabled={context.disabled}
            value={record.comment}
            onValue={(comment) => onRecord({ comment })}
          />
        )}
      </Field>
      <Checkbox
        checked={record.trace_pou}
        disabled={context.disabled}
        onChecked={(trace_pou) => onRecord({ trace_pou })}
      >
        {t('trace.tracePou')}
      </Checkbox>
      <p className={styles.muted}>{t('trace.tracePouHint')}</p>
      <h3>{t('trace.trigger')}</h3>
      <SettingText
        label={t('trace.triggerVariable')}
        field="trigger.variable"
        value={trigger.variable}
        context={context}
        assisted
        code
        onValue={(variable) => setTrigger({ variable })}
      />
      <SettingChoice
        label={t('trace.edge')}
        value={trigger.edge}
        values={EDGES}
        textOf={(edge) => t(`trace.edge.${edge}`)}
        context={context}
        onValue={(edge) => setTrigger({ edge })}
      />
      <SettingText
        label={t('trace.level')}
        field="trigger.level"
        value={trigger.level}
        context={context}
        hint={t('trace.levelHint')}
        assisted
        code
        onValue={(level) => setTrigger({ level })}
      />
      <SettingNumber
        label={t('trace.position')}
        field="position"
        unit="%"
        value={trigger.position}
        context={context}
        hint={t('trace.positionHint')}
        onValue={(position) => setTrigger({ position })}
      />
      <h3>{t('trace.timeAxis')}</h3>
      <TimeAxisFields axis={appearance.x} context={context} onAxis={(x) => setAppearance({ x })} />
      <h3>{t('trace.valueAxis')}</h3>
      <ValueAxisFields axis={appearance.y} context={context} onAxis={(y) => setAppearance({ y })} />
      <h3>{t('trace.display')}</h3>
      <SettingNumber
        label={t('trace.fontSize')}
        field="font_size"
        unit="px"
        value={appearance.font_size}
        context={context}
        onValue={(font_size) => setAppearance({ font_size })}
      />
      <SettingColor
        label={t('trace.background')}
        value={appearance.background}
        usual="#ffffff"
        context={context}
        onValue={(background) => setAppearance({ background })}
      />
      <SettingColor
        label={t('trace.selectedBackground')}
        value={appearance.selected_background}
        usual="#ffffff"
        context={context}
        onValue={(selected_background) => setAppearance({ selected_background })}
      />
      <div className={styles.color}>
        <Button
          disabledReason={context.disabled ? t('reason.engineer') : null}
          onClick={() => setAppearance(USUAL_APPEARANCE)}
        >
          {t('trace.appearanceReset')}
        </Button>
        <Button onClick={() => onUsual(appearance)}>{t('trace.appearanceUsual')}</Button>
      </div>
    </>
  );
}
