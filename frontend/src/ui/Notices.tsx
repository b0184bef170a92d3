import { CircleCheck, CircleX, Info, TriangleAlert, X } from 'lucide-react';
import { useText } from '@/i18n';
import { dismiss, useNotices } from './notices';
import { Button, IconButton } from './Button';
import styles from './Notices.module.css';

const ICONS = {
  info: { icon: Info, color: 'var(--accent)' },
  ok: { icon: CircleCheck, color: 'var(--ok)' },
  warn: { icon: TriangleAlert, color: 'var(--warn)' },
  error: { icon: CircleX, color: 'var(--error)' },
};

export function Notices() {
  const t = useText();
  const notices = useNotices((state) => state.notices);
  return (
    <div className={styles.stack} role="region" aria-live="polite" aria-label={t('notices.label')}>
      {notices.map((notice) => {
        const { icon: Icon, color } = ICONS[notice.tone];
        const action = notice.action;
        return (
          <div key={notice.id} className={styles.notice} data-tone={notice.tone}>
            <Icon size={17} color={color} aria-hidden />
            <div>
              <div className={styles.title}>{notice.title}</div>
              {notice.text && <div className={styles.text}>{notice.text}</div>}
              {action && (
                <Button
                  variant="quiet"
                  className={styles.action}
                  onClick={() => {
                    dismiss(notice.id);
                    action.run();
                  }}
                >
                  {action.text}
                </Button>
              )}
            </div>
            <IconButton small icon={X} label={t('action.close')} onClick={() => dismiss(notice.id)} />
          </div>
        );
      })}
    </div>
  );
}
