import { useMemo } from 'react';
import { useText } from '@/i18n';
import { onlineColumns } from '@/online/columns';
import { LostBar } from '@/online/LostBar';
import { OnlineTable } from '@/online/OnlineTable';
import { useChildren } from '@/online/useChildren';
import type { OnlineSession } from '@/workbench/onlineSession';
import { axisPath } from './live';
import { NotLoggedIn } from './NotLoggedIn';

const OPEN: ReadonlySet<string> = new Set(['axis']);

/** All variables of the axis, which can be written and forced as in a watch list. */
export function ParametersPage({ session, name }: { session: OnlineSession | null; name: string }) {
  const t = useText();
  const columns = useMemo(() => onlineColumns(t), [t]);
  const path = axisPath(name);
  const parents = useMemo(() => [{ key: 'axis', expression: path, label: name, kind: 'fb' }], [path, name]);
  const children = useChildren(session, parents, OPEN).get(path.toUpperCase());
  const roots = useMemo(
    () =>
      (children ?? []).map((child) => ({
        ...child,
        key: child.name,
        expression: `${path}.${child.name}`,
        label: child.name,
      })),
    [children, path],
  );
  if (session === null) return <NotLoggedIn text={t('axis.parametersText')} />;
  return (
    <div style={{ display: 'flex', flexDirection: 'column', height: '100%' }}>
      <LostBar session={session} />
      <OnlineTable label={t('axis.page.parameters')} session={session} roots={roots} columns={columns} />
    </div>
  );
}
