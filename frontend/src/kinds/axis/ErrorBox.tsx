import { useText } from '@/i18n';
import styles from './Axis.module.css';
import { errorText } from './errors';
import { useShown } from './live';

/** An error number in plain words, with what to do; nothing without an error. */
export function ErrorBox({ runtimeId, expression }: { runtimeId: string; expression: string }) {
  const t = useText();
  const name = useShown(runtimeId, expression);
  if (name === null || name === 'SMC_NO_ERROR' || name === '0') return null;
  const { what, remedy } = errorText(name);
  return (
    <div className={styles.error} role="alert">
      <p>
        <b className="code">{name}</b>
      </p>
      <p>{t(what)}</p>
      <p>{t(remedy)}</p>
    </div>
  );
}
