import {
  ChevronFirst,
  ChevronLast,
  History,
  OctagonAlert,
  Pause,
  Play,
  RadioTower,
  StepBack,
  StepForward,
} from 'lucide-react';
import { useMemo } from 'react';
import { useText } from '@/i18n';
import { Button, IconButton } from '@/ui/Button';
import { Select } from '@/ui/Field';
import { useRegistry } from '@/workbench/commands';
import { keysText } from '@/workbench/keys';
import { pastText, spanText } from '@/workbench/online/pastText';
import { useActiveSession } from '@/workbench/online/session';
import type { OnlineSession } from '@/workbench/onlineSession';
import { guard } from '@/ui/notices';
import { runCommand } from '@/workbench/run';
import { closeTimeBar, lookAt, setSpeed, SPEEDS, togglePlay, useTimeBars, type TimeBarState } from './store';
import styles from './TimeBar.module.css';
import { pastMoment, ticksOf } from './timeline';

/** The strip below the tool bar that leads through past cycles. Nothing while it is closed. */
export function TimeBar() {
  const session = useActiveSession();
  const bar = useTimeBars((state) => (session === undefined ? undefined : state.bars[session.runtimeId]));
  return session && bar ? <OpenBar key={session.runtimeId} session={session} bar={bar} /> : null;
}

const MOST_TICKS = 10;

function OpenBar({ session, bar }: { session: OnlineSession; bar: TimeBarState }) {
  const t = useText();
  const { runtimeId } = session;
  const { moments, at } = bar;
  const last = moments.length - 1;
  const shown = at ?? last;
  const ticks = useMemo(() => ticksOf(moments, MOST_TICKS), [moments]);
  const moment = pastMoment(moments, shown, bar.fault);
  const text =
    at === null || moment === null ? t(bar.fault ? 'past.liveFault' : 'past.liveStopped') : pastText(moment, t);
  return (
    <section className={styles.bar} aria-label={t('past.bar')} data-past={at !== null}>
      <History size={15} aria-hidden />
      <span className={styles.buttons}>
        <Act id="past.first" icon={ChevronFirst} />
        <Act id="past.stepBack" icon={StepBack} />
        <IconButton
          small
          icon={bar.playing === null ? Play : Pause}
          label={t(bar.playing === null ? 'past.play' : 'past.pause')}
          onClick={() => togglePlay(runtimeId)}
        />
        <Act id="past.stepForward" icon={StepForward} />
        <Act id="past.last" icon={ChevronLast} />
      </span>
      <Select
        className={styles.speed}
        label={t('past.speed')}
        value={String(bar.playing ?? 1)}
        choices={SPEEDS.map((speed) => ({ value: String(speed), text: `${String(speed)} ×` }))}
        onValue={(speed) => setSpeed(runtimeId, Number(speed))}
      />
      <div className={styles.track}>
        <input
          type="range"
          className={styles.slider}
          aria-label={t('past.slider')}
          aria-valuetext={text}
          min={0}
          max={last}
          step={1}
          value={shown}
          onChange={(event) => lookAt(runtimeId, Number(event.target.value))}
        />
        <div className={styles.ticks} aria-hidden>
          {ticks.map(({ index, before }) => (
            <span key={before} style={{ left: `${String(last === 0 ? 100 : (index / last) * 100)}%` }}>
              {before === 0 ? t(bar.fault ? 'past.fault' : 'past.end') : `−${spanText(before)}`}
            </span>
          ))}
        </div>
      </div>
      <span className={`${styles.moment} digits`} role="status">
        {text}
        {bar.parts > 1 && <span className={styles.parts}>{t('past.parts', { count: bar.parts - 1 })}</span>}
      </span>
      {bar.fault && (
        <Button variant="quiet" icon={OctagonAlert} onClick={() => void runCommand('past.fault')}>
          {t('past.toFault')}
        </Button>
      )}
      <Button icon={RadioTower} onClick={() => void guard(() => closeTimeBar(runtimeId))}>
        {t('past.live')}
      </Button>
    </section>
  );
}

function Act({ id, icon }: { id: string; icon: typeof StepBack }) {
  const t = useText();
  const command = useRegistry((state) => state.commands.get(id));
  if (command === undefined) return null;
  const keys = command.keys?.[0];
  return (
    <IconButton
      small
      icon={icon}
      label={t(command.title)}
      shortcut={keys && keysText(keys)}
      onClick={() => void runCommand(id)}
    />
  );
}
