import { Cpu, Plus, Trash2 } from 'lucide-react';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { RuntimeState } from '@/api/types';
import { useText } from '@/i18n';
import { confirm, openDialog } from '@/ui/dialogs';
import { guard } from '@/ui/notices';
import { LOCAL_RUNTIME } from '@/workbench/online/offlineTarget';
import { runtimeText, toneOfRuntime } from '@/workbench/online/runtimeText';
import { Button, IconButton } from '@/ui/Button';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { ToneDot } from '@/workbench/online/ToneDot';
import { AddRuntimeDialog } from './AddRuntimeDialog';
import styles from './RuntimeList.module.css';

interface RuntimeListProps {
  runtimes: readonly RuntimeState[] | undefined;
  error: unknown;
  chosen: string | null;
  /** Why none can be chosen now. */
  readOnly: string | null;
  onChoose: (runtimeId: string) => void;
}

/** The soft PLCs this server is connected to, with their state; one of them is the device. */
export function RuntimeList({ runtimes, error, chosen, readOnly, onChoose }: RuntimeListProps) {
  const t = useText();
  if (error && !runtimes) return <Failed error={error} />;
  if (!runtimes) return <Loading />;

  const add = async () => {
    const added = await openDialog<RuntimeState>((close) => <AddRuntimeDialog close={close} />);
    if (!added) return;
    await queryClient.invalidateQueries({ queryKey: keys.runtimes });
    if (!readOnly) onChoose(added.id);
  };
  const remove = async (runtime: RuntimeState) => {
    const sure = await confirm({
      title: t('runtime.removeTitle', { name: runtime.name }),
      text: t('runtime.removeText'),
      action: t('action.remove'),
      danger: true,
    });
    if (!sure) return;
    await guard(async () => {
      await api.delete('/api/v1/runtimes/{runtime_id}', { params: { path: { runtime_id: runtime.id } } });
      await queryClient.invalidateQueries({ queryKey: keys.runtimes });
    });
  };

  return (
    <div className={styles.list}>
      {runtimes.length === 0 && <Empty icon={Cpu} title={t('runtime.none')} />}
      <div role="radiogroup" aria-label={t('runtime.choose')} className={styles.list}>
        {runtimes.map((runtime) => (
          <div key={runtime.id} className={styles.runtime} data-chosen={runtime.id === chosen ? '' : undefined}>
            <button
              type="button"
              role="radio"
              aria-checked={runtime.id === chosen}
              aria-label={runtime.name}
              aria-disabled={readOnly ? true : undefined}
              title={readOnly ?? undefined}
              className={styles.radio}
              onClick={() => !readOnly && onChoose(runtime.id)}
            />
            <span>
              <div className={styles.name}>{runtime.name}</div>
              <div className={styles.detail}>{runtime.url}</div>
            </span>
            <span className={styles.state}>
              <ToneDot tone={toneOfRuntime(runtime)} size={8} />
              {runtimeText(runtime, t)}
              {runtime.application && <span className={styles.detail}>{runtime.application}</span>}
            </span>
            <IconButton
              small
              icon={Trash2}
              label={t('runtime.remove', { name: runtime.name })}
              disabledReason={runtime.id === LOCAL_RUNTIME ? t('runtime.local') : null}
              onClick={() => void remove(runtime)}
            />
            {!runtime.connected && runtime.problem && <span className={styles.problem}>{runtime.problem}</span>}
          </div>
        ))}
      </div>
      <div className={styles.tools}>
        <Button icon={Plus} onClick={() => void add()}>
          {t('runtime.add')}
        </Button>
      </div>
    </div>
  );
}
