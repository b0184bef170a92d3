import { useRef, useState } from 'react';
import { api } from '@/api/client';
import type { Schemas } from '@/api/types';
import { useText } from '@/i18n';
import { numberText } from '@/editors/form/numbers';
import { Button } from '@/ui/Button';
import { Checkbox, Field, Select } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { explain } from '@/ui/notices';
import type { CamTable } from './camTable';
import styles from './Cam.module.css';
import type { CamDrawing } from './curves';
import { rounded } from './cells';
import type { CamEdit } from './edit';
import { PlotGrid } from './PlotGrid';
import { valueRange, type GraphName, type Range } from './plot';
import { useSize } from '@/editors/plot/useSize';

const GOALS = ['velocity', 'acceleration', 'jerk'] as const;
type Goal = (typeof GOALS)[number];
const GRAPH: Readonly<Record<Goal, GraphName>> = { velocity: 'v', acceleration: 'a', jerk: 'j' };
const LEFT = 64;

interface Found {
  answer: Schemas['OptimisedCam'];
  drawing: CamDrawing;
  goal: Goal;
}

interface OptimiseDialogProps {
  projectId: string;
  edit: CamEdit;
  close: (answer?: true) => void;
}

/** Moves points so that a peak becomes least; the curve is shown against the one of before until it is taken. */
export function OptimiseDialog({ projectId, edit, close }: OptimiseDialogProps) {
  const t = useText();
  const { cam, selected, drawing } = edit;
  const inner = cam.points.map((_, index) => index).slice(1, -1);
  const own = selected?.kind === 'point' && inner.includes(selected.index) ? [selected.index] : null;
  const [which, setWhich] = useState<'all' | 'own'>(own ? 'own' : 'all');
  const [goal, setGoal] = useState<Goal>('acceleration');
  const [keep, setKeep] = useState(false);
  const [found, setFound] = useState<Found | null>(null);
  const [fault, setFault] = useState<string | null>(null);
  const [busy, setBusy] = useState(false);
  const path = { params: { path: { project_id: projectId } } };
  const changed = <Value,>(set: (value: Value) => void) => {
    return (value: Value) => {
      setFound(null);
      setFault(null);
      set(value);
    };
  };
  const compute = async () => {
    setBusy(true);
    try {
      const points = which === 'own' && own ? own : inner;
      const answer = await api.post('/api/v1/projects/{project_id}/cams/optimise', {
        ...path,
        body: { cam, points, goal, keep_positions: keep },
      });
      const curves = await api.post('/api/v1/projects/{project_id}/cams/curves', {
        ...path,
        body: { cam: answer.cam },
      });
      setFound({ answer, drawing: curves, goal });
      setFault(null);
    } catch (error) {
      setFault(explain(error).text ?? explain(error).title);
    }
    setBusy(false);
  };
  const better = found !== null && found.answer.after < found.answer.before;
  const take = () => {
    if (found && better) edit.change(found.answer.cam);
    close(true);
  };
  return (
    <FormDialog
      title={t('cam.optimise')}
      description={t('cam.optimiseText')}
      width={640}
      action={t('cam.optimiseTake')}
      disabledReason={found === null ? t('cam.optimiseFirst') : better ? null : t('cam.optimiseBest')}
      onClose={() => close()}
      onSubmit={take}
      aside={
        <>
          <Button
            disabledReason={inner.length === 0 ? t('cam.noInner') : null}
            aria-busy={busy}
            onClick={() => void compute()}
          >
            {t('cam.optimiseCompute')}
          </Button>
          <span style={{ flex: 1 }} />
        </>
      }
    >
      <Field row label={t('cam.optimiseGoal')}>
        {(attributes) => (
          <Select<Goal>
            {...attributes}
            value={goal}
            choices={GOALS.map((value) => ({ value, text: t(`cam.quantity.${value}`) }))}
            onValue={changed(setGoal)}
          />
        )}
      </Field>
      <Field row label={t('cam.points')}>
        {(attributes) => (
          <Select<'all' | 'own'>
            {...attributes}
            value={which}
            choices={[
              { value: 'all', text: t('cam.innerPoints', { count: inner.length }) },
              { value: 'own', text: t('cam.selectedPoint'), disabled: own === null },
            ]}
            onValue={changed(setWhich)}
          />
        )}
      </Field>
      <Checkbox checked={keep} onChecked={changed(setKeep)}>
        {t('cam.keepPositions')}
      </Checkbox>
      {fault !== null && (
        <p className={styles.refused} role="alert">
          {fault}
        </p>
      )}
      {found && drawing && (
        <>
          <p className={styles.fastest} role="status">
            {t(better ? 'cam.optimised' : 'cam.optimiseBest', {
              before: numberText(rounded(found.answer.before)),
              after: numberText(rounded(found.answer.after)),
            })}
          </p>
          <Comparison cam={cam} before={drawing} after={found.drawing} graph={GRAPH[found.goal]} />
        </>
      )}
    </FormDialog>
  );
}

interface ComparisonProps {
  cam: CamTable;
  before: CamDrawing;
  after: CamDrawing;
  graph: GraphName;
}

/** A curve as it was, dashed, and as it would be. */
function Comparison({ cam, before, after, graph }: ComparisonProps) {
  const t = useText();
  const frame = useRef<HTMLDivElement>(null);
  const { width, height } = useSize(frame);
  const both: CamDrawing = { ...before, segments: [...before.segments, ...after.segments] };
  const values = valueRange({ ...cam, points: [] }, both, graph);
  const window: Range = { min: cam.points[0]!.x, max: cam.points.at(-1)!.x };
  const px = (x: number) => LEFT + ((x - window.min) / (window.max - window.min)) * Math.max(1, width - LEFT - 8);
  const py = (value: number) => ((values.max - value) / (values.max - values.min)) * height;
  const line = (drawing: CamDrawing) =>
    drawing.segments
      .map((one) =>
        one.x.map((x, at) => `${at === 0 ? 'M' : 'L'}${px(x).toFixed(1)} ${py(one[graph][at]!).toFixed(1)}`).join(''),
      )
      .join('');
  return (
    <div ref={frame} className={styles.comparison} role="img" aria-label={t('cam.comparison')}>
      <svg width={width} height={height} aria-hidden>
        <PlotGrid left={LEFT} right={width - 8} height={height} values={values} py={py} count={height / 30} title={6} />
        <path className={styles.before} d={line(before)} />
        <path className={styles.curve} data-curve={graph} d={line(after)} />
      </svg>
    </div>
  );
}
