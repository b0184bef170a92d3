import { useQuery } from '@tanstack/react-query';
import { useMemo, useState } from 'react';
import { objectQuery, useObjects } from '@/api/queries';
import { ofKind, shaped } from '@/api/objects';
import { useText } from '@/i18n';
import { numberText } from '@/editors/form/numbers';
import { Loading } from '@/ui/Empty';
import { Field, Select } from '@/ui/Field';
import styles from './Cam.module.css';
import { CommitField } from './CommitField';
import { rounded } from './cells';
import type { CamEdit } from './edit';
import { accelerationLimit, fastestMaster, motionAt, peaksOf, type Limits, type Quantity } from './motion';
import { TimePlot } from './TimePlot';

const NO_AXIS = '-';
const SHOWN: readonly Quantity[] = ['position', 'velocity', 'acceleration', 'jerk'];
const UNITS: Readonly<Record<Quantity, string>> = {
  position: 'u',
  velocity: 'u/s',
  acceleration: 'u/s²',
  jerk: 'u/s³',
};

/** What the slave does while the master moves at a constant velocity, with the limits of an axis drawn in. */
export function PreviewTab({ projectId, edit }: { projectId: string; edit: CamEdit }) {
  const t = useText();
  const [speed, setSpeed] = useState(360);
  const [axisId, setAxisId] = useState(NO_AXIS);
  const { data: objects } = useObjects(projectId);
  const axes = objects?.filter((object) => object.kind === 'axis') ?? [];
  const axis = useQuery({
    ...objectQuery(projectId, axisId),
    enabled: axisId !== NO_AXIS,
    select: (object) => shaped(object, ofKind('axis')).data,
  });
  const limits: Limits | null = axisId === NO_AXIS ? null : (axis.data?.dynamic_limits ?? null);
  const { drawing } = edit;
  const motion = useMemo(() => (drawing ? motionAt(drawing, speed) : null), [drawing, speed]);
  if (drawing === null || motion === null) return <Loading />;
  const peaks = peaksOf(drawing);
  const size = Math.abs(speed);
  const rows = (['velocity', 'acceleration', 'jerk'] as const).map((name, at) => {
    const limit = limits === null ? null : name === 'acceleration' ? accelerationLimit(limits) : limits[name];
    const peak = rounded(peaks[name] * size ** (at + 1));
    return { name, peak, limit, beyond: limit !== null && peak > limit * (1 + 1e-9) };
  });
  const limitOf = (name: Quantity) => rows.find((row) => row.name === name)?.limit ?? null;
  const fastest = limits === null ? null : fastestMaster(peaks, limits);
  return (
    <div className={styles.preview}>
      <div className={styles.previewHead}>
        <CommitField
          label={t('cam.masterVelocity')}
          unit="u/s"
          value={speed}
          check={(value) => (Number.isFinite(value) && value !== 0 ? null : t('cam.fault.speed'))}
          onValue={setSpeed}
        />
        <Field row label={t('cam.limitsOf')} hint={axes.length === 0 ? t('cam.noAxis') : undefined}>
          {(attributes) => (
            <Select
              {...attributes}
              value={axisId}
              choices={[
                { value: NO_AXIS, text: t('cam.noLimits') },
                ...axes.map((one) => ({ value: one.id, text: one.name })),
              ]}
              onValue={setAxisId}
            />
          )}
        </Field>
        <table className={styles.peaks}>
          <thead>
            <tr>
              <th />
              <th>{t('cam.peak')}</th>
              <th>{t('cam.limit')}</th>
            </tr>
          </thead>
          <tbody>
            {rows.map(({ name, peak, limit, beyond }) => (
              <tr key={name} data-beyond={beyond || undefined}>
                <th>{t(`cam.quantity.${name}`)}</th>
                <td className="code">{`${numberText(peak)} ${UNITS[name]}`}</td>
                <td className="code">{limit === null ? '' : `${numberText(limit)} ${UNITS[name]}`}</td>
              </tr>
            ))}
          </tbody>
        </table>
        {fastest !== null && (
          <p className={styles.fastest} data-beyond={size > fastest * (1 + 1e-9) || undefined} role="status">
            {Number.isFinite(fastest)
              ? t('cam.fastest', { velocity: numberText(Number(fastest.toPrecision(6))) })
              : t('cam.anyVelocity')}
          </p>
        )}
      </div>
      <div className={styles.stack}>
        {SHOWN.map((name, at) => (
          <TimePlot
            key={name}
            title={`${t(`cam.quantity.${name}`)} [${UNITS[name]}]`}
            curve={(['y', 'v', 'a', 'j'] as const)[at]!}
            time={motion.time}
            values={motion[name]}
            limit={limitOf(name)}
            last={at === SHOWN.length - 1}
          />
        ))}
      </div>
    </div>
  );
}
