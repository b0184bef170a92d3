/** Write, force and release: what is prepared anywhere goes out together (WAT-07). */
import { api } from '@/api/client';
import { t } from '@/i18n';
import { notify } from '@/ui/notices';
import { clearPrepared, preparedValues, takeOpenField, type PreparedValue } from './prepared';

function order(runtimeId: string, values: readonly PreparedValue[]) {
  return {
    params: { path: { runtime_id: runtimeId } },
    body: { values: values.map(({ expression, literal }) => ({ expression, value: literal })) },
  };
}

/** What is prepared, with what is being typed just now; nothing while that is refused. */
function takenValues(runtimeId: string): readonly PreparedValue[] {
  return takeOpenField() ? preparedValues(runtimeId) : [];
}

/** Writes all prepared values together at the beginning of a cycle. */
export async function writePrepared(runtimeId: string): Promise<void> {
  const values = takenValues(runtimeId);
  if (values.length === 0) return;
  await api.post('/api/v1/runtimes/{runtime_id}/values/write', order(runtimeId, values));
  clearPrepared(runtimeId, values);
}

/** Forces all prepared values; they hold until they are released. */
export async function forcePrepared(runtimeId: string): Promise<void> {
  const values = takenValues(runtimeId);
  if (values.length === 0) return;
  await api.post('/api/v1/runtimes/{runtime_id}/values/force', order(runtimeId, values));
  clearPrepared(runtimeId, values);
}

/** Releases forced variables, all when none are named; `restore` gives them back what they held before (WAT-09). */
export async function releaseForces(runtimeId: string, expressions: string[] | null, restore = false): Promise<void> {
  await api.post('/api/v1/runtimes/{runtime_id}/values/unforce', {
    params: { path: { runtime_id: runtimeId } },
    body: { expressions, restore },
  });
  if (expressions === null) notify({ tone: 'ok', title: t('online.unforcedAll') });
}
