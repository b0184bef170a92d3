import type { ReactNode } from 'react';
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

type Mark = 'minimum' | 'maximum' | 'length' | 'major' | 'minor';

/** The time axis (TRC-50 to TRC-59). */
export function TimeAxisFields({ axis, context, onAxis }: AxisFieldsProps<TimeAxis>) {
  const t = useText();
  const mark = (field: Mark, hint?: string) => (
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
  return <AxisFields of="x" axis={axis} context={context} onAxis={onAxis} mark={mark} />;
}

/** A value axis (TRC-53 to TRC-61). */
export function ValueAxisFields({ axis, context, onAxis }: AxisFieldsProps<ValueAxis>) {
  const t = useText();
  const mark = (field: Mark, hint?: string) => (
    <SettingNumber
      label={t(`trace.axis.${field}`)}
      field={`y.${field}`}
      value={axis[field]}
      context={context}
      hint={hint}
      onValue={(value) => onAxis({ ...axis, [field]: value })}
    />
  );
  return <AxisFields of="y" axis={axis} context={context} onAxis={onAxis} mark={mark} />;
}

const NAMES = { x: 'time', y: 'value' } as const;

type Common = Pick<TimeAxis, 'mode' | 'reverse' | 'description' | 'grid' | 'grid_color' | 'arrow' | 'position'>;

interface CommonFieldsProps<Axis> extends AxisFieldsProps<Axis> {
  of: 'x' | 'y';
}

/** Both axes have the same settings; their marks are durations or numbers. */
function AxisFields<Axis extends Common>(
  props: CommonFieldsProps<Axis> & { mark: (field: Mark, hint?: string) => ReactNode },
) {
  const { of, axis, context, onAxis, mark } = props;
  const t = useText();
  const name = NAMES[of];
  return (
    <>
      <SettingChoice
        label={t('trace.axis.mode')}
        value={axis.mode}
        values={MODES}
        textOf={(mode) => t(`trace.axis.${name}.${mode}`)}
        context={context}
        onValue={(mode) => onAxis({ ...axis, mode })}
      />
      {axis.mode === 'fixed' && (
        <>
          {mark('minimum')}
          {mark('maximum')}
        </>
      )}
      {axis.mode === 'scrolling' && mark('length')}
      {mark('major', t(`trace.axis.${name}Hint`))}
      {mark('minor')}
      <FurtherFields of={of} axis={axis} context={context} onAxis={onAxis} />
    </>
  );
}

function FurtherFields<Axis extends Common>({ axis, context, onAxis, of }: CommonFieldsProps<Axis>) {
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
