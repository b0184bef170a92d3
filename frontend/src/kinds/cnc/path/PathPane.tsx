import { Blend, Grid3x3, LineChart } from 'lucide-react';
import { useCallback, useEffect, useMemo, useRef, useState } from 'react';
import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { useObjectSession } from '@/online/useObjectSession';
import { applicationOf } from '@/project/tree';
import { usePreferences } from '@/session/preferences';
import { IconButton } from '@/ui/Button';
import { Failed, Loading } from '@/ui/Empty';
import { Select } from '@/ui/Field';
import { ViewFrame } from '../../scene/ViewFrame';
import type { ViserWindow } from '../../scene/viserWindow';
import type { CncDocument } from '../cncDocument';
import type { CncProgramData } from '../properties';
import { useProgramVersion } from '../useProgramVersion';
import { runCamera, takePage, type Box, type CameraAct } from './camera';
import { CameraPanel } from './CameraPanel';
import { canMoveEnd, canMoveTangents, PathDrag } from './editing';
import type { Moment } from './motion';
import { MotionPanel } from './MotionPanel';
import styles from './Path.module.css';
import { PathLegend } from './PathLegend';
import { PathOverlay } from './PathOverlay';
import type { Colouring, PathSummary } from './pathView';
import type { Frame, Seen, Vector } from './projection';
import { RealTool } from './RealTool';
import { useEye } from './useEye';
import { usePathView } from './usePathView';
import { usePointing } from './usePointing';

const COLOURINGS = ['kind', 'velocity', 'acceleration', 'curvature'] as const satisfies readonly Colouring[];

interface PathPaneProps {
  projectId: string;
  objectId: string;
  program: CncDocument;
  data: CncProgramData;
  /** The text differs from what is stored. */
  changed: boolean;
  locked: boolean;
  visible: boolean;
  line: number;
  onLine: (line: number) => void;
}

/** The path of the program in 3D: with the text and the table one model (cnc.md sections 4 and 14). */
export function PathPane(props: PathPaneProps) {
  const { projectId, objectId, program, data, changed, locked, visible, line, onLine } = props;
  const t = useText();
  useProgramVersion(program);
  const dark = usePreferences((state) => state.shown === 'dark');
  const [grid, setGrid] = useState(true);
  const [colouring, setColouring] = useState<Colouring>('kind');
  const [preprocessed, setPreprocessed] = useState(false);
  const [playing, setPlaying] = useState(false);
  const [moment, setMoment] = useState<Moment | null>(null);
  const [real, setReal] = useState<{ tool: Vector | null; trace: readonly Vector[] }>({ tool: null, trace: [] });
  const [window, setWindow] = useState<ViserWindow | null>(null);
  const { data: objects } = useObjects(projectId);
  const session = useObjectSession(
    projectId,
    objects?.find(({ id }) => id === objectId),
  );
  const latest = useRef({ data, changed });
  useEffect(() => {
    latest.current = { data, changed };
  });
  const read = useCallback((): CncProgramData | null => {
    const { data, changed } = latest.current;
    return changed ? { ...data, implementation: program.model.getValue() } : null;
  }, [program]);
  const version = useVersion(projectId, objectId, program, data);
  const looks = { dark, grid, colouring, preprocessed };
  const { state, view } = usePathView(projectId, objectId, { version, read, looks, line }, visible);
  const { path, summary, chosen, busy, error } = state;
  const frame = useMemo(
    (): Frame | null => summary && { centre: summary.centre as unknown as Vector, scale: summary.scale },
    [summary],
  );
  const eye = useEye(window, visible);
  const drag = useRef<PathDrag | null>(null);
  const remove = useCallback(() => {
    if (!locked) program.apply([{ from: line, removed: 1, lines: [] }]);
  }, [program, line, locked]);
  const pointed = usePointing(window, view, frame, onLine, remove);
  const camera = (act: CameraAct) => {
    if (window !== null && frame !== null && summary !== null) runCamera(window, act, frame, boxOf(summary));
  };
  const fitted = useRef<ViserWindow | null>(null);
  useEffect(() => {
    // The first picture shows the whole path; later the camera is the user's.
    if (eye === null || window === null || frame === null || summary === null || fitted.current === window) return;
    fitted.current = window;
    runCamera(window, 'alongZ', frame, boxOf(summary));
  }, [eye, window, frame, summary]);
  const onReal = useCallback((tool: Vector | null, trace: readonly Vector[]) => setReal({ tool, trace }), []);
  const onDrag = (at: Seen) => eye !== null && frame !== null && drag.current?.to(at, eye, frame);
  const free = !locked && !preprocessed;
  const place = pointed !== null && pointed.line === line ? pointed.place : (chosen.at(-1)?.end ?? null);
  return (
    <section
      className={styles.pane}
      aria-label={t('cnc.path')}
      data-busy={busy || undefined}
      data-testid="path-pane"
      tabIndex={-1}
      onKeyDown={(event) => {
        // Elsewhere the key belongs to a field.
        if (event.key === 'Delete' && event.target === event.currentTarget) remove();
      }}
    >
      <div className={styles.bar}>
        <Select
          compact
          className={styles.colouring}
          label={t('cnc.path.colouring')}
          value={colouring}
          choices={COLOURINGS.map((value) => ({ value, text: t(`cnc.path.colouring.${value}`) }))}
          onValue={setColouring}
        />
        <IconButton
          small
          icon={Blend}
          label={t('cnc.path.preprocessed')}
          pressed={preprocessed}
          onClick={() => setPreprocessed(!preprocessed)}
        />
        <IconButton small icon={Grid3x3} label={t('cnc.path.grid')} pressed={grid} onClick={() => setGrid(!grid)} />
        <IconButton
          small
          icon={LineChart}
          label={t('cnc.path.motion')}
          pressed={playing}
          onClick={() => setPlaying(!playing)}
        />
        <span
          className={styles.facts}
          aria-live="polite"
          data-testid="path-facts"
          data-tone={summary?.fault ? 'error' : undefined}
        >
          {busy
            ? t('cnc.path.making')
            : (summary?.fault ??
              (summary && t('cnc.path.facts', { count: summary.objects, length: summary.length.toFixed(2) })))}
        </span>
      </div>
      <div className={styles.body}>
        <div className={styles.stage}>
          {path !== null && (
            <ViewFrame
              key={path}
              src={path}
              title={t('cnc.path')}
              shown={visible}
              testId="path-view"
              onDrawn={(drawn) => {
                takePage(drawn);
                setWindow(drawn);
              }}
            />
          )}
          {eye !== null && frame !== null && summary !== null && (
            <PathOverlay
              eye={eye}
              frame={frame}
              summary={summary}
              chosen={chosen}
              line={line}
              movable={(one) => free && canMoveEnd(program, one)}
              tangents={(one) => free && canMoveTangents(program, one)}
              tool={moment?.place ?? real.tool}
              trace={real.trace}
              onChoose={onLine}
              onGrip={(grip) => (drag.current = new PathDrag(program, grip))}
              onDrag={onDrag}
              onDrop={() => {
                drag.current?.drop();
                drag.current = null;
              }}
            />
          )}
          {window !== null && <CameraPanel run={camera} />}
          {window !== null && session === null && place !== null && (
            <div className={styles.status} data-testid="path-position">
              {['X', 'Y', 'Z'].map((axis, at) => `${axis} ${place[at]!.toFixed(3)}`).join('  ')}
            </div>
          )}
          {window !== null && summary !== null && <PathLegend colouring={colouring} legend={summary.legend} />}
          {error !== null && (
            <div className={styles.cover}>
              <Failed error={error} retry={() => view.retry()} />
            </div>
          )}
          {error === null && window === null && (
            <div className={styles.cover}>
              <Loading />
            </div>
          )}
        </div>
        {playing && <MotionPanel view={view} drawn={summary} onMoment={setMoment} />}
      </div>
      {session !== null && <RealTool runtimeId={session.runtimeId} objectId={objectId} onTool={onReal} />}
    </section>
  );
}

function boxOf({ low, high }: PathSummary): Box {
  return { low: low as unknown as Vector, high: high as unknown as Vector };
}

/** What tells one path from another: text, properties, and the settings of the application. */
function useVersion(projectId: string, objectId: string, program: CncDocument, data: CncProgramData): string {
  const { data: objects } = useObjects(projectId);
  const application = objects && applicationOf(objects, objectId);
  const settings = objects?.find(({ kind, parent_id }) => kind === 'cnc_settings' && parent_id === application?.id);
  const properties = useMemo(() => JSON.stringify({ ...data, implementation: null, view: null }), [data]);
  return `${String(program.model.getAlternativeVersionId())} ${String(settings?.revision ?? 0)} ${properties}`;
}
