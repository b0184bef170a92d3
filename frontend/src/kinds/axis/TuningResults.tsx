import { Download, FolderInput } from 'lucide-react';
import { useText } from '@/i18n';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import { Button } from '@/ui/Button';
import { Facts } from '@/ui/Facts';
import { RadioCards } from '@/ui/RadioCards';
import styles from './Axis.module.css';
import tuningStyles from './Tuning.module.css';
import {
  AIMS,
  GAIN_UNITS,
  gainRows,
  shown,
  type Aim,
  type GainRow,
  type Measured,
  type Proposal,
  type Tuning,
} from './tuning';

interface TuningResultsProps {
  tuning: Tuning;
  measured: Measured;
  proposal: Proposal | null;
  aim: Aim;
  onAim: (aim: Aim) => void;
  writeReason: string | null;
  onWrite: (rows: readonly GainRow[]) => void;
  takeReason: string | null;
  onTake: () => void;
}

/** What a measurement says: figures of the answer, the model, and gains beside the present ones. */
export function TuningResults(props: TuningResultsProps) {
  const t = useText();
  const { tuning, measured, proposal, aim, onAim } = props;
  const rows = gainRows(tuning, proposal);
  return (
    <>
      {measured.problem !== null && (
        <div className={form.banner} data-tone="warn" role="alert">
          {measured.problem}
        </div>
      )}
      {proposal !== null && (
        <Section title={t('axis.tuning.gains')}>
          <RadioCards<Aim>
            label={t('axis.tuning.aim')}
            value={aim}
            cards={AIMS.map((one) => ({
              value: one,
              name: t(`axis.tuning.aim.${one}`),
              effect: t(`axis.tuning.effect.${measured.closed_in}.${one}`),
            }))}
            onValue={onAim}
          />
          <table className={tuningStyles.gains}>
            <thead>
              <tr>
                <th scope="col">{t('axis.tuning.gain')}</th>
                <th scope="col">{t('axis.tuning.present')}</th>
                <th scope="col">{t('axis.tuning.proposed')}</th>
              </tr>
            </thead>
            <tbody>
              {rows.map((row) => (
                <tr key={row.name}>
                  <th scope="row">{t(`axis.tuning.gain.${row.name}`)}</th>
                  <td className="code">{withUnit(row, row.present, t('axis.cycles'))}</td>
                  <td className={`${tuningStyles.proposed} code`}>
                    {row.proposed === null ? '–' : withUnit(row, row.proposed, t('axis.cycles'))}
                  </td>
                </tr>
              ))}
            </tbody>
          </table>
          <p className={form.note}>
            {t('axis.tuning.margins', {
              phase: shown(proposal.phase_margin_deg, 3),
              gain: proposal.gain_margin === null ? '∞' : shown(proposal.gain_margin, 3),
            })}{' '}
            {t(`axis.tuning.source.${measured.closed_in}`)}
          </p>
          <div className={styles.buttons}>
            <Button
              variant="primary"
              icon={Download}
              disabledReason={props.writeReason}
              onClick={() => props.onWrite(rows)}
            >
              {t('axis.tuning.write')}
            </Button>
            <Button icon={FolderInput} disabledReason={props.takeReason} onClick={props.onTake}>
              {t('axis.tuning.take')}
            </Button>
          </div>
        </Section>
      )}
      <div className={tuningStyles.tables}>
        {measured.figures !== null && <FigureFacts measured={measured} />}
        {measured.model !== null && <ModelFacts measured={measured} />}
      </div>
    </>
  );
}

function withUnit(row: GainRow, value: number, cycles: string): string {
  return `${shown(value)} ${row.name === 'dead_time' ? cycles : GAIN_UNITS[row.name]}`;
}

function FigureFacts({ measured }: { measured: Measured }) {
  const t = useText();
  const figures = measured.figures!;
  const seconds = (value: number | null) =>
    value === null ? t('axis.tuning.notReached') : `${shown(value * 1000)} ms`;
  return (
    <Section title={t('axis.tuning.figures')}>
      <Facts>
        <Row text={t('axis.tuning.deadCycles')}>
          {figures.dead_time_cycles === null
            ? t('axis.tuning.notReached')
            : `${figures.dead_time_cycles} (${shown(figures.dead_time_cycles * measured.cycle_s * 1000)} ms)`}
        </Row>
        <Row text={t('axis.tuning.rise')}>{seconds(figures.rise_time_s)}</Row>
        <Row text={t('axis.tuning.overshoot')}>{`${shown(figures.overshoot * 100, 3)} %`}</Row>
        <Row text={t('axis.tuning.settling', { band: shown(figures.band, 3) })}>{seconds(figures.settling_time_s)}</Row>
        <Row text={t('axis.tuning.steadyError')}>{`${shown(figures.steady_error, 3)} u`}</Row>
        <Row text={t('axis.tuning.noise')}>{`${shown(figures.noise, 3)} u`}</Row>
      </Facts>
    </Section>
  );
}

function ModelFacts({ measured }: { measured: Measured }) {
  const t = useText();
  const model = measured.model!;
  const cycles = (seconds: number) =>
    `${shown(seconds * 1000)} ms (${t('axis.tuning.inCycles', { factor: shown(seconds / measured.cycle_s, 3) })})`;
  return (
    <Section title={t('axis.tuning.modelTitle')}>
      <Facts>
        <Row text={t(`axis.tuning.modelDead.${measured.closed_in}`)}>{cycles(model.dead_time_s)}</Row>
        <Row text={t('axis.tuning.lag')}>{cycles(model.lag_s)}</Row>
        {model.inertia === null ? (
          <Row text={t('axis.tuning.factor')}>{shown(model.factor)}</Row>
        ) : (
          <Row text={t('axis.tuning.inertia')}>{`${shown(model.inertia)} kgm²`}</Row>
        )}
        <Row text={t('axis.tuning.residual')}>
          {`${shown(model.residual, 3)} u (${shown((100 * model.residual) / Math.abs(measured.height), 2)} %)`}
        </Row>
      </Facts>
    </Section>
  );
}

function Row({ text, children }: { text: string; children: string }) {
  return (
    <>
      <dt>{text}</dt>
      <dd className="digits">{children}</dd>
    </>
  );
}
