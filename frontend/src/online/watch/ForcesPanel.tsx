import { LockKeyhole } from 'lucide-react';
import { useCallback, useMemo, type KeyboardEvent } from 'react';
import { language, useText, type t as Text } from '@/i18n';
import { guard } from '@/ui/notices';
import { useOnline } from '@/workbench/onlineSession';
import { useActiveSession } from '@/workbench/online/session';
import { useProject } from '@/project/openProject';
import { saveBlob } from '@/workbench/downloadFile';
import { runCommand } from '@/workbench/run';
import type { PanelProps } from '@/workbench/panels';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import type { MenuEntry } from '@/ui/Menu';
import { releaseForces } from '../acts';
import { LostBar } from '../LostBar';
import { onlineColumns } from '../columns';
import { OnlineTable } from '../OnlineTable';
import styles from '../OnlineTable.module.css';
import { commonEntries } from '../rowMenu';
import type { OnlineRow } from '../treeRows';
import { expressionKey } from '../item';
import { useComments } from '../useComments';
import { usePrepared } from '../prepared';
import { ForceFiles } from './ForceFiles';
import { forcesText } from './listFile';
import { useForces, type ForcedVariable } from './useForces';
import watch from './Watch.module.css';

const NONE: readonly string[] = [];

/** `API · curl/8.5.0, 10.0.0.7`: what the order came from, what a script calls itself, and the address. */
function sourceText(t: typeof Text, { source, program, address }: ForcedVariable): string {
  if (source === '') return '';
  const name = t(`forces.source.${source as 'api' | 'wire' | 'workbench'}`);
  const detail = [program, address].filter((part) => part !== '').join(', ');
  return detail === '' ? name : t('forces.sourceOf', { source: name, detail });
}

/** All forced variables of the active application; release keeps the value or restores the one before (WAT-08, WAT-09). */
export default function ForcesPanel({ visible }: PanelProps) {
  const t = useText();
  const session = useActiveSession() ?? null;
  const projectId = useProject((state) => state.projectId);
  const comments = useComments(projectId);
  const prepared = usePrepared(({ values }) => Object.keys(values[session?.runtimeId ?? ''] ?? {}).length > 0);
  const paths = useOnline((state) => (session === null ? NONE : (state.forces[session.runtimeId] ?? NONE)));
  const { data: origins } = useForces(session?.runtimeId ?? null, paths);
  const columns = useMemo(() => {
    const all = onlineColumns(t);
    const extra = [
      { id: 'before', title: t('forces.before'), width: 110 },
      { id: 'user', title: t('forces.user'), width: 110 },
      { id: 'source', title: t('forces.source'), width: 200 },
      { id: 'since', title: t('forces.since'), width: 170 },
    ];
    return [...all.slice(0, 4), ...extra, ...all.slice(4)];
  }, [t]);
  const extraCell = useCallback(
    (row: OnlineRow, column: string) => {
      const origin = origins?.get(expressionKey(row.expression));
      if (origin === undefined) return null;
      switch (column) {
        case 'before':
          return <span className={watch.code}>{origin.before}</span>;
        case 'user':
          return <span>{origin.user}</span>;
        case 'source':
          return <span>{sourceText(t, origin)}</span>;
        case 'since':
          return origin.at === null ? null : (
            <span>{new Date(origin.at).toLocaleString(language(), { dateStyle: 'short', timeStyle: 'medium' })}</span>
          );
        default:
          return null;
      }
    },
    [origins, t],
  );
  const roots = useMemo(
    () => paths.map((path) => ({ key: path, label: path, expression: path, comment: comments(path) })),
    [paths, comments],
  );
  const release = (rows: readonly OnlineRow[], restore: boolean) => {
    if (session === null || rows.length === 0) return;
    const expressions = rows.map((row) => row.expression);
    void guard(() => releaseForces(session.runtimeId, expressions, restore));
  };
  const onKey = (event: KeyboardEvent, rows: readonly OnlineRow[]): boolean => {
    if (event.key !== 'Delete') return false;
    release(rows, false);
    return true;
  };
  const menu = (rows: readonly OnlineRow[]): MenuEntry[] => {
    const reason = rows.length === 0 ? t('watch.selectLine') : null;
    return [
      {
        kind: 'item',
        key: 'keep',
        text: t('forces.release'),
        shortcut: 'Del',
        disabledReason: reason,
        run: () => release(rows, false),
      },
      {
        kind: 'item',
        key: 'restore',
        text: t('forces.restore'),
        disabledReason: reason,
        run: () => release(rows, true),
      },
      { kind: 'line', key: 'line' },
      ...commonEntries(t, session, rows),
    ];
  };
  if (session === null) return <Empty icon={LockKeyhole} title={t('forces.offline')} text={t('forces.offlineText')} />;
  if (paths.length === 0)
    return (
      <Empty icon={LockKeyhole} title={t('forces.none')} text={t('forces.noneText')}>
        <ForceFiles runtimeId={session.runtimeId} />
      </Empty>
    );
  const save = () => {
    const forces = paths.map((path) => ({
      expression: path,
      literal: origins?.get(expressionKey(path))?.literal ?? '',
    }));
    saveBlob(new Blob([forcesText(forces)], { type: 'text/plain' }), 'forces.txt');
  };
  const all = () => roots.map((root): OnlineRow => ({ ...root, depth: 0, root: 0, open: undefined }));
  return (
    <div className={styles.panel}>
      <LostBar session={session} />
      <div className={styles.bar}>
        <span style={{ marginRight: 'auto' }}>{t('forces.count', { count: paths.length })}</span>
        <ForceFiles runtimeId={session.runtimeId} onExport={save} />
        <Button
          variant="quiet"
          icon={LockKeyhole}
          disabledReason={prepared ? null : t('reason.nothingPrepared')}
          onClick={() => void runCommand('online.forceValues')}
        >
          {t('forces.forcePrepared')}
        </Button>
        <Button variant="quiet" onClick={() => release(all(), false)}>
          {t('forces.releaseAll')}
        </Button>
        <Button variant="quiet" onClick={() => release(all(), true)}>
          {t('forces.restoreAll')}
        </Button>
      </div>
      <div>
        <OnlineTable
          label={t('forces.title')}
          session={session}
          roots={roots}
          columns={columns}
          onKey={onKey}
          menu={menu}
          extraCell={extraCell}
          visible={visible}
        />
      </div>
    </div>
  );
}
