import { useText } from '@/i18n';
import { Checkbox } from '@/ui/Field';
import type { TimeAxis, ValueAxis } from './configuration';
import { SettingChoice, SettingColor, SettingNumber, SettingText, type FieldContext } from './fields';

const MODES = ['auto', 'fixed', 'scrolling'] as const;
const POSITIONS = ['low', 'middle', 'high'] as const;
const ARROWS = ['none', 'open', 'filled'] as const;

interface AxisFieldsProps<Axis> {
  axis: Axis;
  context: FieldContext;
  onAxis: (axis: Axis) => void;
}

/** The time axis (TRC-50 to TRC-59). */
export function TimeAxisFields({ axis, context, onAxis }: AxisFieldsProps<TimeAxis>) {
  const t = useText();
  const text = (field: 'minimum' | 'maximum' | 'length' | 'major' | 'minor', hint?: string) => (
    <SettingText
      label={t(`trace.axis.${field}`)}
      field={`x.${field}`}
      value={axis[field]}
      context={context}
      code
      hint={hint}
      onValue={(value) => onAxis({ ...axis, [field]: value })}
    />
  );
  return (
    <>
      <SettingChoice
        label={t('trace.axis.mode')}
        value={axis.mode}
        values={MODES}
        textOf={(mode) => t(`trace.axis.time.${mode}`)}
        context={context}
        onValue={(mode) => onAxis({ ...axis, mode })}
      />
      {axis.mode === 'fixed' && (
        <>
          {text('minimum')}
          {text('maximum')}
        </>
      )}
      {axis.mode === 'scrolling' && text('length')}
      {text('major', t('trace.axis.timeHint'))}
      {text('minor')}
      <FurtherFields axis={axis} context={context} onAxis={onAxis} of="x" />
    </>
  );
}

/** A value axis (TRC-53 to TRC-61). */
export function ValueAxisFields({ axis, context, onAxis }: AxisFieldsProps<ValueAxis>) {
  const t = useText();
  const number = (field: 'minimum' | 'maximum' | 'length' | 'major' | 'minor', hint?: string) => (
    <SettingNumber
      label={t(`trace.axis.${field}`)}
      field={`y.${field}`}
      value={axis[field]}
      context={context}
      hint={hint}
      onValue={(value) => onAxis({ ...axis, [field]: value })}
    />
  );
  return (
    <>
      <SettingChoice
        label={t('trace.axis.mode')}
        value={axis.mode}
        values={MODES}
        textOf={(mode) => t(`trace.axis.value.${mode}`)}
        context={context}
        onValue={(mode) => onAxis({ ...axis, mode })}
      />
      {axis.mode === 'fixed' && (
        <>
          {number('minimum')}
          {number('maximum')}
        </>
      )}
      {axis.mode === 'scrolling' && number('length')}
      {number('major', t('trace.axis.valueHint'))}
      {number('minor')}
      <FurtherFields axis={axis} context={context} onAxis={onAxis} of="y" />
    </>
  );
}

type Common = Pick<TimeAxis, 'reverse' | 'description' | 'grid' | 'grid_color' | 'arrow' | 'position'>;

function FurtherFields<Axis extends Common>({ axis, context, onAxis, of }: AxisFieldsProps<Axis> & { of: 'x' | 'y' }) {
  const t = useText();
  return (
    <>
      <SettingText
        label={t('trace.axis.description')}
        field={`${of}.description`}
        value={axis.description}
        context={context}
        onValue={(description) => onAxis({ ...axis, description })}
      />
      <SettingChoice
        label={t('trace.axis.position')}
        value={axis.position}
        values={POSITIONS}
        textOf={(position) => t(`trace.axis.${of}.${position}`)}
        context={context}
        onValue={(position) => onAxis({ ...axis, position })}
      />
      <SettingChoice
        label={t('trace.axis.arrow')}
        value={axis.arrow}
        values={ARROWS}
        textOf={(arrow) => t(`trace.axis.arrow.${arrow}`)}
        context={context}
        onValue={(arrow) => onAxis({ ...axis, arrow })}
      />
      <Checkbox checked={axis.grid} disabled={context.disabled} onChecked={(grid) => onAxis({ ...axis, grid })}>
        {t('trace.axis.grid')}
      </Checkbox>
      {axis.grid && (
        <SettingColor
          label={t('trace.axis.gridColor')}
          value={axis.grid_color}
          usual="#c8cdd7"
          context={context}
          onValue={(grid_color) => onAxis({ ...axis, grid_color })}
        />
      )}
      <Checkbox
        checked={axis.reverse}
        disabled={context.disabled}
        onChecked={(reverse) => onAxis({ ...axis, reverse })}
      >
        {t('trace.axis.reverse')}
      </Checkbox>
    </>
  );
}
