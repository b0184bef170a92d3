import { ArrowLeft, ArrowRight, House, MoveRight, SquarePen } from 'lucide-react';
import { useState, type KeyboardEvent } from 'react';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import type { OnlineSession } from '@/workbench/onlineSession';
import { Section } from '@/editors/form/FormPage';
import styles from './Axis.module.css';
import { ControlBar, PowerButtons, useControlReasons } from './ControlBar';
import { useAxisControl, type Motion, type SteerAction } from './control';
import { ErrorBox } from './ErrorBox';
import { panelPath } from './live';
import type { AxisSettings } from './model';
import { NumberField } from '@/editors/form/NumberField';

interface ControlProps {
  session: OnlineSession;
  name: string;
  settings: AxisSettings;
}

/** Takes control of the axis and moves it; what is not possible now says why. */
export function ControlSection({ session, name, settings }: ControlProps) {
  const t = useText();
  const { runtimeId } = session;
  const control = useAxisControl(runtimeId, name);
  const panel = panelPath(name);
  const [position, setPosition] = useState(0);
  const [distance, setDistance] = useState(10);
  const [velocity, setVelocity] = useState(() => settings.dynamic_limits.velocity / 10);
  const [acceleration, setAcceleration] = useState(settings.dynamic_limits.acceleration);
  const [deceleration, setDeceleration] = useState(settings.dynamic_limits.deceleration);

  const reasons = useControlReasons(session, name, control);
  const { inControl } = reasons;
  const numbersFault =
    [velocity, acceleration, deceleration].every((value) => value > 0) && Number.isFinite(position + distance)
      ? null
      : t('axis.motionFault');
  const movable = inControl ?? numbersFault;
  const motion = (target: number): Motion => ({
    position: target,
    velocity,
    acceleration,
    deceleration,
    jerk: settings.dynamic_limits.jerk,
  });

  return (
    <Section title={t('axis.control')}>
      <ControlBar name={name} control={control} reasons={reasons} />
      <PowerButtons control={control} disabledReason={inControl} />
      <div className={styles.buttons}>
        <JogButton forward={false} disabledReason={movable} steer={(action) => control.steer(action, motion(0))} />
        <JogButton forward disabledReason={movable} steer={(action) => control.steer(action, motion(0))} />
      </div>
      <div className={styles.motion}>
        <NumberField label={t('axis.target')} unit="u" value={position} onValue={setPosition} />
        <NumberField label={t('axis.distance')} unit="u" value={distance} onValue={setDistance} />
        <NumberField label={t('axis.limit.velocity')} unit="u/s" value={velocity} onValue={setVelocity} />
        <NumberField label={t('axis.limit.acceleration')} unit="u/s²" value={acceleration} onValue={setAcceleration} />
        <NumberField label={t('axis.limit.deceleration')} unit="u/s²" value={deceleration} onValue={setDeceleration} />
      </div>
      <div className={styles.buttons}>
        <Button
          icon={MoveRight}
          disabledReason={movable}
          onClick={() => control.steer('move_absolute', motion(position))}
        >
          {t('axis.moveAbsolute')}
        </Button>
        <Button
          icon={MoveRight}
          disabledReason={movable}
          onClick={() => control.steer('move_relative', motion(distance))}
        >
          {t('axis.moveRelative')}
        </Button>
        <Button
          icon={SquarePen}
          disabledReason={movable}
          onClick={() => control.steer('set_position', motion(position))}
        >
          {t('axis.setPosition')}
        </Button>
        <Button icon={House} disabledReason={movable} onClick={() => control.steer('home', motion(position))}>
          {t('axis.home')}
        </Button>
      </div>
      <ErrorBox runtimeId={runtimeId} expression={`${panel}.eError`} />
    </Section>
  );
}

interface JogProps {
  forward: boolean;
  disabledReason: string | null;
  steer: (action: SteerAction) => void;
}

/** Moves the axis as long as it is pressed, with the mouse or with Space. */
function JogButton({ forward, disabledReason, steer }: JogProps) {
  const t = useText();
  const [pressed, setPressed] = useState(false);
  const begin = () => {
    if (disabledReason !== null || pressed) return;
    setPressed(true);
    steer(forward ? 'jog_forward' : 'jog_backward');
  };
  const end = () => {
    if (!pressed) return;
    setPressed(false);
    steer('jog_end');
  };
  const isSpace = (event: KeyboardEvent) => event.key === ' ';
  return (
    <Button
      icon={forward ? ArrowRight : ArrowLeft}
      disabledReason={disabledReason}
      aria-pressed={pressed}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        begin();
      }}
      onPointerUp={end}
      onPointerCancel={end}
      onLostPointerCapture={end}
      onBlur={end}
      onKeyDown={(event) => {
        if (isSpace(event) && !event.repeat) begin();
      }}
      onKeyUp={(event) => {
        if (isSpace(event)) end();
      }}
    >
      {t(forward ? 'axis.jogForward' : 'axis.jogBackward')}
    </Button>
  );
}
