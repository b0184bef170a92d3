import { useState } from 'react';
import { NumberField } from '@/editors/form/NumberField';
import { useText } from '@/i18n';
import { Checkbox } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import styles from './Cnc.module.css';
import { AXES } from './gcodes';
import { MOST_COPIES, type ArrayShape } from './operations/array';

interface Closing<Answer> {
  close: (answer?: Answer) => void;
}

/** Axes that a program can be moved along (CNC-86): those of positions, not of orientations. */
const MOVED = [...'XYZPQUVW'];

/** The vector that a program is moved by, in the order of all axes. */
export function MoveDialog({ close }: Closing<readonly number[]>) {
  const t = useText();
  const [vector, setVector] = useState<readonly number[]>([...AXES].map(() => 0));
  const fault = vector.every(Number.isFinite) ? null : t('cnc.faultNumber');
  return (
    <FormDialog
      title={t('cnc.moveTitle')}
      description={t('cnc.moveText')}
      action={t('cnc.do')}
      disabledReason={fault}
      onClose={() => close()}
      onSubmit={() => close(vector)}
    >
      <div className={styles.fields}>
        {MOVED.map((letter) => {
          const axis = AXES.indexOf(letter);
          return (
            <NumberField
              key={letter}
              label={letter}
              value={vector[axis]!}
              error={Number.isFinite(vector[axis]) ? null : t('cnc.faultNumber')}
              onValue={(value) => setVector(vector.map((now, at) => (at === axis ? value : now)))}
            />
          );
        })}
      </div>
    </FormDialog>
  );
}

/** Degrees counter-clockwise. */
export function RotateDialog({ close }: Closing<number>) {
  const t = useText();
  const [degrees, setDegrees] = useState(90);
  const fault = Number.isFinite(degrees) ? null : t('cnc.faultNumber');
  return (
    <FormDialog
      title={t('cnc.rotateTitle')}
      description={t('cnc.rotateText')}
      action={t('cnc.do')}
      disabledReason={fault}
      onClose={() => close()}
      onSubmit={() => close(degrees)}
    >
      <NumberField label={t('cnc.angle')} unit="°" value={degrees} error={fault} onValue={setDegrees} />
    </FormDialog>
  );
}

export function StretchDialog({ close }: Closing<{ factor: number; distances: boolean }>) {
  const t = useText();
  const [factor, setFactor] = useState(2);
  const [distances, setDistances] = useState(true);
  const fault = !Number.isFinite(factor) ? t('cnc.faultNumber') : factor === 0 ? t('cnc.faultZero') : null;
  return (
    <FormDialog
      title={t('cnc.stretchTitle')}
      description={t('cnc.stretchText')}
      action={t('cnc.do')}
      disabledReason={fault}
      onClose={() => close()}
      onSubmit={() => close({ factor, distances })}
    >
      <NumberField label={t('cnc.factor')} value={factor} error={fault} onValue={setFactor} />
      <Checkbox checked={distances} onChecked={setDistances}>
        {t('cnc.distancesToo')}
      </Checkbox>
    </FormDialog>
  );
}

/** Columns along X and rows along Y. */
export function ArrayDialog({ close }: Closing<ArrayShape>) {
  const t = useText();
  const [shape, setShape] = useState<ArrayShape>({ columns: 2, rows: 1, dx: 100, dy: 100 });
  const isCount = (value: number) => Number.isInteger(value) && value >= 1 && value <= MOST_COPIES;
  const counts = isCount(shape.columns) && isCount(shape.rows) && shape.columns * shape.rows <= MOST_COPIES;
  const counted = counts ? null : t('cnc.faultCount', { most: MOST_COPIES });
  const fault = counted ?? (Number.isFinite(shape.dx + shape.dy) ? null : t('cnc.faultNumber'));
  const field = (name: keyof ArrayShape, label: string, error: string | null) => (
    <NumberField
      label={label}
      value={shape[name]}
      error={error}
      onValue={(value) => setShape({ ...shape, [name]: value })}
    />
  );
  return (
    <FormDialog
      title={t('cnc.arrayTitle')}
      description={t('cnc.arrayText')}
      action={t('cnc.do')}
      disabledReason={fault}
      onClose={() => close()}
      onSubmit={() => close(shape)}
    >
      <div className={styles.fields}>
        {field('columns', t('cnc.columns'), counts ? null : counted)}
        {field('dx', t('cnc.columnDistance'), Number.isFinite(shape.dx) ? null : t('cnc.faultNumber'))}
        {field('rows', t('cnc.rows'), counts ? null : counted)}
        {field('dy', t('cnc.rowDistance'), Number.isFinite(shape.dy) ? null : t('cnc.faultNumber'))}
      </div>
    </FormDialog>
  );
}
