import { Pause, Play, SkipBack } from 'lucide-react';
import { useEffect, useRef, useState } from 'react';
import { useText } from '@/i18n';
import { IconButton } from '@/ui/Button';
import { Failed, Loading } from '@/ui/Empty';
import { Select } from '@/ui/Field';
import { MotionChart } from './MotionChart';
import { momentAt, SPEEDS, timeText, type Moment, type Speed } from './motion';
import styles from './Path.module.css';
import type { PathSamples, PathView } from './pathView';

interface MotionPanelProps {
  view: PathView;
  /** What is drawn; another one has another motion. */
  drawn: unknown;
  onMoment: (moment: Moment | null) => void;
}

type Loaded = { drawn: unknown; samples: PathSamples | null; error: unknown };

/** Plays the motion of the runtime's own interpolator on the path. */
export function MotionPanel({ view, drawn, onMoment }: MotionPanelProps) {
  const t = useText();
  const [loaded, setLoaded] = useState<Loaded | null>(null);
  const [attempt, setAttempt] = useState(0);
  const [time, setTime] = useState(0);
  const [playing, setPlaying] = useState(false);
  const [speed, setSpeed] = useState<Speed>('1');
  useEffect(() => {
    let current = true;
    view.motion().then(
      (samples) => current && setLoaded({ drawn, samples, error: null }),
      (error: unknown) => current && setLoaded({ drawn, samples: null, error }),
    );
    return () => {
      current = false;
    };
  }, [view, drawn, attempt]);
  const samples = loaded?.samples ?? null;
  const duration = samples?.duration ?? 0;
  const shown = Math.min(time, duration);
  const tell = useRef(onMoment);
  useEffect(() => {
    tell.current = onMoment;
  });
  useEffect(() => {
    tell.current(samples === null ? null : momentAt(samples, shown));
  }, [samples, shown]);
  useEffect(() => () => tell.current(null), []);
  useEffect(() => {
    if (!playing || duration === 0) return;
    let before: number | null = null;
    let request = 0;
    const step = (ms: number) => {
      const passed = before === null ? 0 : ((ms - before) / 1000) * Number(speed);
      before = ms;
      setTime((now) => Math.min(now + passed, duration));
      request = requestAnimationFrame(step);
    };
    request = requestAnimationFrame(step);
    return () => cancelAnimationFrame(request);
  }, [playing, speed, duration]);
  const ended = duration > 0 && shown >= duration;
  if (playing && ended) setPlaying(false);
  if (loaded?.error != null)
    return (
      <div className={styles.motion}>
        <Failed error={loaded.error} retry={() => setAttempt(attempt + 1)} />
      </div>
    );
  if (samples === null)
    return (
      <div className={styles.motion}>
        <Loading />
      </div>
    );
  const moment = momentAt(samples, shown);
  return (
    <div className={styles.motion} role="group" aria-label={t('cnc.motion')} data-testid="path-motion">
      <div className={styles.player}>
        <IconButton icon={SkipBack} label={t('cnc.motion.begin')} onClick={() => setTime(0)} />
        <IconButton
          icon={playing ? Pause : Play}
          label={t(playing ? 'cnc.motion.pause' : 'cnc.motion.play')}
          disabledReason={duration === 0 ? t('cnc.motion.none') : null}
          onClick={() => {
            if (ended) setTime(0);
            setPlaying(!playing);
          }}
        />
        <Select
          compact
          className={styles.speed}
          label={t('cnc.motion.speed')}
          value={speed}
          choices={SPEEDS.map((value) => ({ value, text: `${value} ×` }))}
          onValue={setSpeed}
        />
        <input
          type="range"
          className={styles.slider}
          aria-label={t('cnc.motion.time')}
          aria-valuetext={timeText(shown)}
          min={0}
          max={duration || 1}
          step="any"
          value={shown}
          onChange={(event) => setTime(Number(event.target.value))}
        />
        <span className={styles.time}>
          {timeText(shown)} / {timeText(duration)}
        </span>
        <span className={styles.moment}>
          {moment !== null && moment.line >= 0 && t('cnc.motion.line', { line: String(moment.line + 1) })}
          {moment !== null && ` · ${t('cnc.motion.now', { velocity: moment.velocity.toFixed(2) })}`}
        </span>
      </div>
      {samples.fault !== null && <p className={styles.fault}>{samples.fault}</p>}
      <MotionChart samples={samples} time={shown} onTime={setTime} />
    </div>
  );
}
