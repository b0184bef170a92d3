import { Hand, OctagonX, Power, RotateCcw, Unlock } from 'lucide-react';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { confirm } from '@/ui/dialogs';
import { notifyError } from '@/ui/notices';
import type { OnlineSession } from '@/workbench/onlineSession';
import styles from './Axis.module.css';
import type { AxisControl } from './control';
import { panelPath, useShown } from './live';
import { useMotionRefusal } from './useMotionRefusal';

export interface Reasons {
  /** Why nobody can control the axis from here. */
  blocked: string | null;
  /** Somebody else controls it. */
  others: string | null;
  /** Why this page cannot move it now. */
  inControl: string | null;
}

/** Why an axis cannot be controlled, in the words of the user. */
export function useControlReasons(session: OnlineSession, name: string, control: AxisControl): Reasons {
  const t = useText();
  const state = useShown(session.runtimeId, `${panelPath(name)}.eState`);
  const blocked = useMotionRefusal(session);
  const others = state !== null && state !== 'Free' && !control.mine ? t('axis.othersControl') : null;
  const inControl = blocked ?? (control.mine && state === 'Control' ? null : t('axis.needsControl'));
  return { blocked, others, inControl };
}

interface ControlBarProps {
  name: string;
  control: AxisControl;
  reasons: Reasons;
}

/** Takes control of the axis and gives it back; stops it. */
export function ControlBar({ name, control, reasons }: ControlBarProps) {
  const t = useText();
  const { blocked, others, inControl } = reasons;
  const take = async () => {
    try {
      if (await control.take(false)) return;
      const force = await confirm({
        title: t('axis.forceTitle', { name }),
        text: t('axis.forceText', { name }),
        action: t('axis.force'),
      });
      if (force) await control.take(true);
    } catch (error) {
      notifyError(error);
    }
  };
  return (
    <div className={styles.control} data-mine={control.mine}>
      <p role="status">
        {control.mine
          ? t('axis.controlMine')
          : control.lost
            ? t('axis.controlLost')
            : (others ?? t('axis.controlFree'))}
      </p>
      {control.mine ? (
        <Button icon={Unlock} onClick={control.release}>
          {t('axis.release')}
        </Button>
      ) : (
        <Button variant="primary" icon={Hand} disabledReason={blocked ?? others} onClick={() => void take()}>
          {t('axis.take')}
        </Button>
      )}
      <Button variant="danger" icon={OctagonX} disabledReason={inControl} onClick={control.stop}>
        {t('axis.stop')}
      </Button>
    </div>
  );
}

interface PowerButtonsProps {
  control: AxisControl;
  disabledReason: string | null;
}

/** Power stage and errors. */
export function PowerButtons({ control, disabledReason }: PowerButtonsProps) {
  const t = useText();
  return (
    <div className={styles.buttons}>
      <Button icon={Power} disabledReason={disabledReason} onClick={() => control.steer('power_on')}>
        {t('axis.powerOn')}
      </Button>
      <Button icon={Power} disabledReason={disabledReason} onClick={() => control.steer('power_off')}>
        {t('axis.powerOff')}
      </Button>
      <Button icon={RotateCcw} disabledReason={disabledReason} onClick={() => control.steer('reset')}>
        {t('axis.reset')}
      </Button>
    </div>
  );
}
