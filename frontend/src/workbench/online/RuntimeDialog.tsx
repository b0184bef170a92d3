import { useState } from 'react';
import type { RuntimeState } from '@/api/types';
import { useText } from '@/i18n';
import { FormDialog } from '@/ui/FormDialog';
import { ToneDot } from './ToneDot';
import styles from './dialogs.module.css';
import { runtimeText, toneOfRuntime } from './runtimeText';

interface RuntimeDialogProps {
  runtimes: readonly RuntimeState[];
  /** Runtime that the device names and that no longer exists. */
  missing: string | null;
  close: (chosen?: RuntimeState) => void;
}

/** Chooses the soft PLC that a device stands for. */
export function RuntimeDialog({ runtimes, missing, close }: RuntimeDialogProps) {
  const t = useText();
  const [chosen, setChosen] = useState<RuntimeState | undefined>(
    runtimes.find((runtime) => runtime.connected) ?? runtimes[0],
  );
  return (
    <FormDialog
      title={t('runtime.choose')}
      description={t(runtimes.length === 0 ? 'runtime.none' : missing ? 'runtime.missing' : 'runtime.chooseText')}
      onClose={() => close()}
      onSubmit={() => chosen && close(chosen)}
      action={t('action.choose')}
      disabledReason={chosen ? null : t('runtime.none')}
      focusAction
    >
      {runtimes.length > 0 && (
        <div role="radiogroup" aria-label={t('runtime.choose')} className={styles.runtimes}>
          {runtimes.map((runtime) => (
            <button
              key={runtime.id}
              type="button"
              role="radio"
              aria-checked={runtime.id === chosen?.id}
              className={styles.runtime}
              onClick={() => setChosen(runtime)}
            >
              <ToneDot tone={toneOfRuntime(runtime)} size={8} />
              <span>
                <span className={styles.name}>{runtime.name}</span>
                <span className={styles.effect}>{runtime.url}</span>
              </span>
              <span className={styles.effect}>{runtimeText(runtime, t)}</span>
            </button>
          ))}
        </div>
      )}
    </FormDialog>
  );
}
