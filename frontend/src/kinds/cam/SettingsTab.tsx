import { useText } from '@/i18n';
import { FormPage, Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import type { Draft } from '@/editors/form/useDraft';
import { Checkbox, Field, Select } from '@/ui/Field';
import { confirm } from '@/ui/dialogs';
import { domainOf, FARTHEST, type CamTable } from './camTable';
import { CommitField } from './CommitField';
import type { CamEdit } from './edit';
import { setPeriod, setRange } from './points';

type Format = CamTable['compile_format'];
const FORMATS: readonly Format[] = ['polynomial', 'segments', 'one_dimensional', 'two_dimensional'];
const LARGEST_TABLE = 10_000;
const CHECKS = ['velocity', 'acceleration', 'jerk'] as const;

/** The properties of a cam: ranges, period, checks and what it is compiled into (CAM-71 to CAM-75). */
export function SettingsTab({ draft, edit }: { draft: Draft<CamTable>; edit: CamEdit }) {
  const t = useText();
  const { cam, locked } = edit;
  const [first, last] = domainOf(cam);
  const number = (value: number) =>
    !Number.isFinite(value) ? t('cam.fault.number') : Math.abs(value) > FARTHEST ? t('cam.fault.far') : null;
  const order = (value: number, least: number, greatest: number) =>
    number(value) ?? (least < greatest ? null : t('cam.fault.order'));
  const range = async (from: number, to: number) => {
    const next = setRange(cam, from, to);
    const lost = next.points + next.tappets > 0;
    if (
      lost &&
      !(await confirm({
        title: t('cam.rangeTitle'),
        text: t('cam.rangeText', { points: next.points, tappets: next.tappets }),
        action: t('cam.rangeAction'),
        danger: true,
      }))
    )
      return;
    edit.change(next.cam, null);
  };
  const table = cam.compile_format === 'one_dimensional' || cam.compile_format === 'two_dimensional';
  return (
    <FormPage draft={draft}>
      {() => (
        <>
          <Section title={t('cam.dimensions')}>
            <div className={form.fields}>
              <CommitField
                label={t('cam.masterStart')}
                unit="u"
                value={first}
                disabled={locked}
                check={(value) => order(value, value, last)}
                onValue={(value) => void range(value, last)}
              />
              <CommitField
                label={t('cam.masterEnd')}
                unit="u"
                value={last}
                disabled={locked}
                check={(value) => order(value, first, value)}
                onValue={(value) => void range(first, value)}
              />
              <CommitField
                label={t('cam.slaveStart')}
                hint={t('cam.slaveHint')}
                unit="u"
                value={cam.slave_start}
                disabled={locked}
                check={(value) => order(value, value, cam.slave_end)}
                onValue={(slave_start) => edit.change({ ...cam, slave_start })}
              />
              <CommitField
                label={t('cam.slaveEnd')}
                unit="u"
                value={cam.slave_end}
                disabled={locked}
                check={(value) => order(value, cam.slave_start, value)}
                onValue={(slave_end) => edit.change({ ...cam, slave_end })}
              />
            </div>
          </Section>
          <Section title={t('cam.transition')}>
            <div className={form.fields}>
              <Checkbox
                checked={cam.periodic}
                disabled={locked}
                onChecked={(periodic) => edit.change(setPeriod(cam, { periodic }))}
              >
                {t('cam.periodic')}
              </Checkbox>
              <p className={form.note}>{t('cam.periodicText')}</p>
              <CommitField
                label={t('cam.slavePeriod')}
                unit="u"
                value={cam.slave_period}
                disabled={locked}
                check={(value) => number(value) ?? (value > 0 ? null : t('cam.fault.positive'))}
                onValue={(slave_period) => edit.change(setPeriod(cam, { slave_period }))}
              />
            </div>
          </Section>
          <Section title={t('cam.checks')}>
            <p className={form.note}>{t('cam.checksText')}</p>
            <div className={form.fields}>
              <Checkbox checked disabled onChecked={() => undefined}>
                {t('cam.check.position')}
              </Checkbox>
              {CHECKS.map((name) => (
                <Checkbox
                  key={name}
                  checked={cam.checks[name]}
                  disabled={locked}
                  onChecked={(wanted) => edit.change({ ...cam, checks: { ...cam.checks, [name]: wanted } })}
                >
                  {t(`cam.check.${name}`)}
                </Checkbox>
              ))}
            </div>
          </Section>
          <Section title={t('cam.compile')}>
            <div className={form.fields}>
              <Field row label={t('cam.format')} hint={t(`cam.format.${cam.compile_format}Text`)}>
                {(attributes) => (
                  <Select<Format>
                    {...attributes}
                    disabled={locked}
                    value={cam.compile_format}
                    choices={FORMATS.map((value) => ({ value, text: t(`cam.format.${value}`) }))}
                    onValue={(compile_format) => edit.change({ ...cam, compile_format })}
                  />
                )}
              </Field>
              {table && (
                <>
                  <CommitField
                    label={t('cam.tableSize')}
                    hint={t('cam.tableSizeHint')}
                    value={cam.table_size}
                    disabled={locked}
                    check={(value) =>
                      Number.isInteger(value) && value >= 2 && value <= LARGEST_TABLE
                        ? null
                        : t('cam.fault.tableSize', { greatest: LARGEST_TABLE })
                    }
                    onValue={(table_size) => edit.change({ ...cam, table_size })}
                  />
                  <Checkbox checked={cam.cubic} disabled={locked} onChecked={(cubic) => edit.change({ ...cam, cubic })}>
                    {t('cam.cubic')}
                  </Checkbox>
                </>
              )}
            </div>
          </Section>
        </>
      )}
    </FormPage>
  );
}
