import { LoaderCircle, TriangleAlert } from 'lucide-react';
import { useEffect, useState, type ReactNode } from 'react';
import { useText } from '@/i18n';
import { explain } from './notices';
import type { IconComponent } from '@/icons/IconComponent';
import { Button } from './Button';
import styles from './Empty.module.css';

interface EmptyProps {
  icon?: IconComponent;
  title: string;
  /** What this place is for. */
  text?: string;
  /** The first thing to do here. */
  children?: ReactNode;
}

export function Empty({ icon: Icon, title, text, children }: EmptyProps) {
  return (
    <div className={styles.frame}>
      <div className={styles.empty}>
        {Icon && <Icon size={28} strokeWidth={1.25} aria-hidden />}
        <div className={styles.title}>{title}</div>
        {text && <div className={styles.text}>{text}</div>}
        {children && <div className={styles.actions}>{children}</div>}
      </div>
    </div>
  );
}

export function Spinner({ size = 16 }: { size?: number }) {
  return <LoaderCircle size={size} className={styles.spinner} aria-hidden />;
}

/** Shown only when loading takes long enough to be noticed, so that quick answers do not flicker. */
export function Loading() {
  const t = useText();
  const [shown, setShown] = useState(false);
  useEffect(() => {
    const timer = setTimeout(() => setShown(true), 250);
    return () => clearTimeout(timer);
  }, []);
  return (
    <div className={styles.loading} role="status" aria-busy aria-label={t('state.loading')}>
      {shown && <Spinner size={20} />}
    </div>
  );
}

export function Failed({ error, retry }: { error: unknown; retry?: () => void }) {
  const t = useText();
  const { title, text } = explain(error);
  return (
    <Empty icon={TriangleAlert} title={title} text={text}>
      {retry && <Button onClick={retry}>{t('action.retry')}</Button>}
    </Empty>
  );
}
