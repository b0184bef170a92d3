import { LockKeyhole } from 'lucide-react';
import { useMemo, type KeyboardEvent } from 'react';
import { useText } from '@/i18n';
import { guard } from '@/ui/notices';
import { useOnline } from '@/workbench/onlineSession';
import { useActiveSession } from '@/workbench/online/session';
import { useProject } from '@/project/openProject';
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
import { useComments } from '../useComments';

const NONE: readonly string[] = [];

/** All forced variables of the active application; release keeps the value or restores the one before (WAT-08, WAT-09). */
export default function ForcesPanel({ visible }: PanelProps) {
  const t = useText();
  const session = useActiveSession() ?? null;
  const projectId = useProject((state) => state.projectId);
  const comments = useComments(projectId);
  const columns = useMemo(() => onlineColumns(t), [t]);
  const paths = useOnline((state) => (session === null ? NONE : (state.forces[session.runtimeId] ?? NONE)));
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
  if (paths.length === 0) return <Empty icon={LockKeyhole} title={t('forces.none')} text={t('forces.noneText')} />;
  const all = () => roots.map((root): OnlineRow => ({ ...root, depth: 0, root: 0, open: undefined }));
  return (
    <div className={styles.panel}>
      <LostBar session={session} />
      <div className={styles.bar}>
        <span style={{ marginRight: 'auto' }}>{t('forces.count', { count: paths.length })}</span>
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
          visible={visible}
        />
      </div>
    </div>
  );
}
