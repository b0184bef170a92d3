import { useQuery, useQueryClient } from '@tanstack/react-query';
import { Activity, Play } from 'lucide-react';
import { useState } from 'react';
import { api } from '@/api/client';
import { useText } from '@/i18n';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import { NumberField } from '@/editors/form/NumberField';
import { LostBar } from '@/online/LostBar';
import { useWatched } from '@/online/useLive';
import { Button } from '@/ui/Button';
import { Empty, Failed, Loading, Spinner } from '@/ui/Empty';
import { Field, Select } from '@/ui/Field';
import { notify, notifyError } from '@/ui/notices';
import type { OnlineSession } from '@/workbench/onlineSession';
import styles from './Axis.module.css';
import { useAxisControl } from './control';
import { ControlBar, PowerButtons, useControlReasons } from './ControlBar';
import { ErrorBox } from './ErrorBox';
import { axisPath, panelPath, useShown } from './live';
import type { AxisSettings } from './model';
import { NotLoggedIn } from './NotLoggedIn';
import { ResponseChart } from './ResponseChart';
import tuningStyles from './Tuning.module.css';
import { TuningResults } from './TuningResults';
import {
  durationFault,
  heightFault,
  withGains,
  writtenValue,
  type Aim,
  type Excitation,
  type GainRow,
  type Measured,
  type Tuning,
} from './tuning';

interface TuningPageProps {
  session: OnlineSession | null;
  name: string;
  settings: AxisSettings;
  /** Why the settings cannot be changed, or null. */
  readOnly: string | null;
  change: (settings: AxisSettings) => void;
}

/** Measures the position loop of an axis and proposes gains for it (devices.md, 14.5). */
export function TuningPage({ session, ...rest }: TuningPageProps) {
  const t = useText();
  if (session === null) return <NotLoggedIn text={t('axis.tuning.loggedOutText')} />;
  return <Loaded key={session.runtimeId} session={session} {...rest} />;
}

type OnlineProps = TuningPageProps & { session: OnlineSession };

function tuningKey(session: OnlineSession, name: string) {
  return ['axis tuning', session.runtimeId, session.runtime?.code_id ?? null, name] as const;
}

function Loaded(props: OnlineProps) {
  const { session, name } = props;
  const path = { runtime_id: session.runtimeId, axis: name };
  const { data, error, refetch } = useQuery({
    queryKey: tuningKey(session, name),
    queryFn: () => api.get('/api/v1/runtimes/{runtime_id}/axes/{axis}/tuning', { params: { path } }),
    retry: false,
  });
  if (error) return <Failed error={error} retry={() => void refetch()} />;
  if (data === undefined) return <Loading />;
  return <TuningOnline {...props} tuning={data} />;
}

function TuningOnline({ session, name, settings, readOnly, change, tuning }: OnlineProps & { tuning: Tuning }) {
  const t = useText();
  const queries = useQueryClient();
  const { runtimeId } = session;
  const [axis, panel] = [axisPath(name), panelPath(name)];
  const [watched] = useState(() => [`${axis}.nAxisState`, `${panel}.eState`, `${panel}.ePhase`, `${panel}.eError`]);
  useWatched(runtimeId, watched);
  const control = useAxisControl(runtimeId, name);
  const reasons = useControlReasons(session, name, control);
  const state = useShown(runtimeId, `${axis}.nAxisState`);
  const phase = useShown(runtimeId, `${panel}.ePhase`);
  const [excitation, setExcitation] = useState<Excitation>(tuning.excitation);
  const [height, setHeight] = useState(tuning.height);
  const [duration, setDuration] = useState(tuning.duration_s);
  const [waiting, setWaiting] = useState(false);
  const [measured, setMeasured] = useState<Measured | null>(null);
  const [aim, setAim] = useState<Aim>('no_overshoot');

  const wrongHeight = heightFault(height);
  const wrongDuration = durationFault(duration);
  const notStanding = state === 'standstill' ? null : t('axis.tuning.needsStandstill');
  const faulty = wrongHeight ?? wrongDuration;
  const measureReason =
    reasons.inControl ?? (waiting ? t('axis.tuning.running') : null) ?? notStanding ?? (faulty && t(faulty));
  const proposal = measured?.proposals.find((one) => one.aim === aim) ?? null;
  const taken = proposal && withGains(settings, proposal);

  const measure = async () => {
    setWaiting(true);
    try {
      setMeasured(
        await api.post('/api/v1/runtimes/{runtime_id}/axes/{axis}/tuning/measure', {
          params: { path: { runtime_id: runtimeId, axis: name } },
          body: { holder: control.holder, excitation, height, duration_s: duration },
        }),
      );
    } catch (error) {
      notifyError(error);
    } finally {
      setWaiting(false);
    }
  };
  const write = async (rows: readonly GainRow[]) => {
    try {
      await api.post('/api/v1/runtimes/{runtime_id}/values/write', {
        params: { path: { runtime_id: runtimeId } },
        body: {
          values: rows.flatMap(({ expression, proposed }) =>
            proposed === null ? [] : [{ expression, value: writtenValue(proposed) }],
          ),
        },
      });
      await queries.invalidateQueries({ queryKey: tuningKey(session, name) });
      notify({ tone: 'ok', title: t('axis.tuning.written', { name }), text: t('axis.tuning.writtenText') });
    } catch (error) {
      notifyError(error);
    }
  };
  const take = () => {
    if (taken) {
      change(taken);
      notify({ tone: 'ok', title: t('axis.tuning.taken', { name }) });
    }
  };

  return (
    <div className={form.page}>
      <LostBar session={session} />
      <div className={tuningStyles.page}>
        <div className={tuningStyles.columns}>
          <div className={tuningStyles.column}>
            <Section title={t('axis.tuning.measurement')}>
              <p className={form.note}>{t(`axis.tuning.text.${tuning.closed_in}`)}</p>
              <ControlBar name={name} control={control} reasons={reasons} />
              <PowerButtons control={control} disabledReason={reasons.inControl} />
              <div className={tuningStyles.fields}>
                {tuning.closed_in === 'controller' && (
                  <Field row label={t('axis.tuning.excitation')} hint={t(`axis.tuning.excitationHint.${excitation}`)}>
                    {(attributes) => (
                      <Select<Excitation>
                        {...attributes}
                        value={excitation}
                        choices={(['step', 'move'] as const).map((value) => ({
                          value,
                          text: t(`axis.tuning.excitation.${value}`),
                        }))}
                        onValue={setExcitation}
                      />
                    )}
                  </Field>
                )}
                <NumberField
                  label={t('axis.tuning.height')}
                  unit="u"
                  hint={
                    tuning.lag_limit === null
                      ? undefined
                      : t('axis.tuning.heightHint', { limit: String(Number(tuning.lag_limit.toPrecision(4))) })
                  }
                  value={height}
                  error={wrongHeight && t(wrongHeight)}
                  onValue={setHeight}
                />
                <NumberField
                  label={t('axis.tuning.duration')}
                  unit="s"
                  value={duration}
                  error={wrongDuration && t(wrongDuration)}
                  onValue={setDuration}
                />
              </div>
              <div className={styles.buttons}>
                <Button variant="primary" icon={Play} disabledReason={measureReason} onClick={() => void measure()}>
                  {t('axis.tuning.measure')}
                </Button>
                {waiting && (
                  <span className={tuningStyles.waiting} role="status">
                    <Spinner />
                    {t(`axis.tuning.phase.${PHASES.find((one) => one === phase) ?? 'Idle'}`)}
                  </span>
                )}
              </div>
              <ErrorBox runtimeId={runtimeId} expression={`${panel}.eError`} />
            </Section>
          </div>
          <div className={tuningStyles.column}>
            {measured === null ? (
              <div className={tuningStyles.empty}>
                <Empty icon={Activity} title={t('axis.tuning.emptyTitle')} text={t('axis.tuning.emptyText')} />
              </div>
            ) : (
              <>
                <ResponseChart measured={measured} proposal={proposal} />
                <TuningResults
                  tuning={tuning}
                  measured={measured}
                  proposal={proposal}
                  aim={aim}
                  onAim={setAim}
                  writeReason={reasons.blocked}
                  onWrite={(rows) => void write(rows)}
                  takeReason={readOnly ?? (taken === null ? t('axis.tuning.notInProject') : null)}
                  onTake={take}
                />
              </>
            )}
          </div>
        </div>
      </div>
    </div>
  );
}

const PHASES = ['Resting', 'Responding', 'Returning', 'Ending'] as const;
