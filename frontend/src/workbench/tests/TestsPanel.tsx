import {
  ChevronRight,
  CircleCheck,
  CircleMinus,
  CircleX,
  FlaskConical,
  Play,
  RotateCcw,
  TriangleAlert,
} from 'lucide-react';
import { useMemo, useState, type KeyboardEvent } from 'react';
import { useQuery } from '@tanstack/react-query';
import { keys, queryClient, testRunQuery } from '@/api/queries';
import type { ObjectSummary, TestFailure, TestRun } from '@/api/types';
import { useText } from '@/i18n';
import { openObject } from '../docking/dock';
import { useProject } from '@/project/openProject';
import { secondText } from '../clock';
import { runCommand } from '../run';
import { FilterInput } from '@/ui/Filter';
import { useToggleSet } from '@/ui/toggleSet';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { Panel } from '@/ui/Panel';
import { rowsOf, type Outcome, type Row } from './model';
import { setFilter, useTests } from './store';
import styles from './Tests.module.css';

const ICONS = { passed: CircleCheck, failed: CircleX, error: TriangleAlert, skipped: CircleMinus };
const OUTCOMES: readonly Outcome[] = ['passed', 'failed', 'error', 'skipped'];

/** Results of the last test run: suites, tests, failures. Enter or a double click on a failure leads to its place. */
export default function TestsPanel() {
  const t = useText();
  const { filter } = useTests();
  const { projectId, applicationId, busy } = useProject();
  const { data: last, isPending } = useQuery({
    ...testRunQuery(projectId ?? '', applicationId ?? ''),
    enabled: projectId !== null && applicationId !== null,
  });
  const [closed, toggleClosed] = useToggleSet<string>();
  const [onlyBad, setOnlyBad] = useState(false);
  const [current, setCurrent] = useState<string | null>(null);
  const report = last?.report ?? null;
  const rows = useMemo(() => {
    const words = (failure: TestFailure) =>
      failure.expected === null
        ? failure.message
        : t('tests.values', { message: failure.message, expected: failure.expected, actual: failure.actual ?? '' });
    return report ? rowsOf(report, closed, onlyBad, words) : [];
  }, [report, closed, onlyBad, t]);

  const twist = (row: Row) => toggleClosed(row.id);
  const open = (row: Row) => {
    if (row.failure) showPlace(row.failure);
    else if (row.open !== null) twist(row);
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const at = rows.findIndex((row) => row.id === current);
    const row = rows[at];
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (by) setCurrent(rows[Math.max(0, Math.min(rows.length - 1, at + by))]?.id ?? null);
    else if (event.key === 'Enter' && row) open(row);
    else if (event.key === 'ArrowRight' && row?.open === false) twist(row);
    else if (event.key === 'ArrowLeft' && row?.open) twist(row);
    else return;
    event.preventDefault();
  };

  const run = (
    <Button icon={Play} onClick={() => void runCommand('build.runTests')} disabledReason={busy ? busy.text : null}>
      {t('tests.run')}
    </Button>
  );
  return (
    <Panel>
      <div className={styles.bar}>
        {report && run}
        {report && (
          <Button
            icon={RotateCcw}
            onClick={() => void runCommand('build.runFailedTests')}
            disabledReason={busy ? busy.text : report.failed + report.error === 0 ? t('tests.noneFailed') : null}
          >
            {t('tests.runFailed')}
          </Button>
        )}
        <FilterInput className={styles.filter} label={t('tests.filter')} value={filter} onValue={setFilter} />
        {report &&
          OUTCOMES.map((outcome) => {
            const Icon = ICONS[outcome];
            return (
              <span key={outcome} className={styles.count}>
                <Icon size={14} className={styles[outcome]} aria-hidden />
                {t(`tests.${outcome}`, { count: report[outcome] })}
              </span>
            );
          })}
        {report && (
          <label className={styles.only}>
            <input type="checkbox" checked={onlyBad} onChange={(event) => setOnlyBad(event.target.checked)} />
            {t('tests.onlyBad')}
          </label>
        )}
      </div>
      {last && <LastRun run={last} />}
      {report?.problem && (
        <div className={styles.problem} role="alert">
          {report.problem}
        </div>
      )}
      {report ? (
        <div
          className={styles.tree}
          data-outdated={last?.outdated || undefined}
          role="tree"
          tabIndex={0}
          aria-label={t('tests.title')}
          aria-activedescendant={current ? `test-${current}` : undefined}
          onKeyDown={onKeyDown}
        >
          {rows.map((row) => (
            <TestRow
              key={row.id}
              row={row}
              selected={row.id === current}
              onSelect={() => setCurrent(row.id)}
              onOpen={() => open(row)}
              onTwist={() => twist(row)}
            />
          ))}
        </div>
      ) : isPending ? null : (
        <Empty icon={FlaskConical} title={t('tests.none')} text={t('tests.noneText')}>
          {run}
        </Empty>
      )}
    </Panel>
  );
}

/** Of when and of what the results are. */
function LastRun({ run }: { run: TestRun }) {
  const t = useText();
  return (
    <div className={styles.run} role="status">
      {t('tests.ranAt', {
        at: secondText(run.at),
        revision: run.revision,
        name: run.username,
        seconds: run.seconds.toFixed(1),
      })}
      {run.outdated && <strong>{t('tests.outdated')}</strong>}
    </div>
  );
}

interface TestRowProps {
  row: Row;
  selected: boolean;
  onSelect: () => void;
  onOpen: () => void;
  onTwist: () => void;
}

function TestRow({ row, selected, onSelect, onOpen, onTwist }: TestRowProps) {
  const t = useText();
  const Icon = ICONS[row.outcome];
  return (
    <div
      id={`test-${row.id}`}
      className={styles.row}
      role="treeitem"
      aria-level={row.level}
      aria-expanded={row.open ?? undefined}
      aria-selected={selected}
      style={{ paddingLeft: row.level * 16 - 8 }}
      onClick={onSelect}
      onDoubleClick={onOpen}
    >
      <span className={styles.twist} data-open={row.open ? '' : undefined} onClick={onTwist}>
        {row.open !== null && <ChevronRight size={14} aria-hidden />}
      </span>
      {row.level < 3 && <Icon size={15} className={styles[row.outcome]} aria-label={t(`tests.is.${row.outcome}`)} />}
      <span className={row.level === 3 ? styles.failure : undefined}>{row.text}</span>
      {row.counts && <span className={styles.quiet}>{t('tests.ofAll', { ...row.counts })}</span>}
      {row.seconds ? <span className={styles.quiet}>{t('tests.simulated', { seconds: row.seconds })}</span> : null}
      {row.failure && <span className={styles.quiet}>{placeText(row.failure, t)}</span>}
    </div>
  );
}

function placeText(failure: TestFailure, t: ReturnType<typeof useText>): string {
  if (!failure.pou || failure.line === null) return failure.pou;
  return t('tests.place', { pou: failure.pou, line: failure.line });
}

function showPlace(failure: TestFailure): void {
  const { projectId } = useProject.getState();
  const objects = (projectId && queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId))) || [];
  const object = objects.find((candidate) => candidate.id === failure.object_id);
  if (!object) return;
  openObject(object.id, object.name, { place: { part: failure.part ?? undefined, line: failure.line ?? undefined } });
}
