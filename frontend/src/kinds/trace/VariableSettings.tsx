import { useText } from '@/i18n';
import { Checkbox } from '@/ui/Field';
import { ValueAxisFields } from './AppearanceFields';
import { GRAPH_TYPES, type Channel, type Warning } from './configuration';
import { canvasColor, automaticColor } from './diagram/ink';
import { common, SettingChoice, SettingColor, SettingNumber, SettingText, type FieldContext } from './fields';

const AXES = ['0', '1', '2', '3', '4', '5', '6', '7'] as const;

interface VariableSettingsProps {
  /** One, or several that are changed together; `number` is that of the first in its record. */
  channels: readonly Channel[];
  number: number;
  context: FieldContext;
  onChannels: (change: (channel: Channel) => Channel) => void;
}

/** The settings of variables (TRC-40 to TRC-47). What differs among several is empty, and stays until it is changed. */
export function VariableSettings({ channels, number, context, onChannels }: VariableSettingsProps) {
  const t = useText();
  const [first] = channels;
  if (first === undefined) return null;
  const one = channels.length === 1;
  const set = (change: Partial<Channel>) => onChannels((channel) => ({ ...channel, ...change }));
  const warning = (of: 'minimum_warning' | 'maximum_warning') => {
    const change = (part: Partial<Warning>) =>
      onChannels((channel) => ({ ...channel, [of]: { ...channel[of], ...part } }));
    const on = channels.every((channel) => channel[of].on);
    return (
      <>
        <Checkbox checked={on} disabled={context.disabled} onChecked={(next) => change({ on: next })}>
          {t(`trace.${of}`)}
        </Checkbox>
        {on && (
          <>
            <SettingNumber
              label={t(`trace.${of}.limit`)}
              field={of}
              value={common(channels, (channel) => channel[of].limit)}
              context={context}
              onValue={(limit) => change({ limit })}
            />
            <SettingColor
              label={t('trace.warningColor')}
              value={common(channels, (channel) => channel[of].color)}
              usual="#ff0000"
              required
              context={context}
              onValue={(color) => change({ color })}
            />
          </>
        )}
      </>
    );
  };
  return (
    <>
      <h3>{one ? t('trace.variable') : t('trace.variables', { count: channels.length })}</h3>
      {one && (
        <>
          <SettingText
            label={t('trace.variable')}
            field="variable"
            value={first.variable}
            context={context}
            hint={first.formula.trim() ? t('trace.variableUnused') : t('trace.variableHint')}
            assisted
            code
            onValue={(variable) => set({ variable })}
          />
          <SettingText
            label={t('trace.formula')}
            field="formula"
            value={first.formula}
            context={context}
            hint={t('trace.formulaHint')}
            code
            onValue={(formula) => set({ formula })}
          />
          <SettingText
            label={t('trace.channelName')}
            field="name"
            value={first.name}
            context={context}
            onValue={(name) => set({ name })}
          />
        </>
      )}
      <SettingColor
        label={t('trace.color')}
        value={common(channels, ({ color }) => color)}
        usual={canvasColor(automaticColor(number))}
        context={context}
        onValue={(color) => set({ color })}
      />
      <SettingChoice
        label={t('trace.graph')}
        value={common(channels, ({ graph }) => graph)}
        values={GRAPH_TYPES}
        textOf={(graph) => t(`trace.graph.${graph}`)}
        context={context}
        onValue={(graph) => set({ graph })}
      />
      <SettingChoice
        label={t('trace.axisNumber')}
        value={common(channels, ({ axis }) => String(axis)) as (typeof AXES)[number] | null}
        values={AXES}
        textOf={(axis) => (axis === '0' ? t('trace.axisFirst') : t('trace.axisFurther', { number: Number(axis) + 1 }))}
        context={context}
        onValue={(axis) => set({ axis: Number(axis) })}
      />
      <Checkbox
        checked={channels.every(({ visible }) => visible)}
        disabled={context.disabled}
        onChecked={(visible) => set({ visible })}
      >
        {t('trace.visible')}
      </Checkbox>
      <h3>{t('trace.warnings')}</h3>
      {warning('minimum_warning')}
      {warning('maximum_warning')}
      <h3>{t('trace.ownAxis')}</h3>
      <ValueAxisFields axis={first.appearance} context={context} onAxis={(appearance) => set({ appearance })} />
    </>
  );
}
