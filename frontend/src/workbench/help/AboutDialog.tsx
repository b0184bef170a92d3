import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import { useText } from '@/i18n';
import { TappetMark } from '@/icons/TappetMark';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';

export function AboutDialog({ close }: { close: () => void }) {
  const t = useText();
  const { data } = useQuery({ queryKey: ['health'], queryFn: () => api.get('/api/v1/health') });
  return (
    <Dialog
      title={t('command.about')}
      width={380}
      onClose={close}
      footer={<Button onClick={close}>{t('action.close')}</Button>}
    >
      <div style={{ display: 'grid', gridTemplateColumns: 'auto 1fr', columnGap: 16, alignItems: 'center' }}>
        <TappetMark size={44} />
        <div>
          <div style={{ fontSize: 17, fontWeight: 600, lineHeight: '24px' }}>Tappet</div>
          {data?.version && (
            <div style={{ color: 'var(--fg-muted)' }}>{t('about.version', { version: data.version })}</div>
          )}
        </div>
      </div>
      <p style={{ color: 'var(--fg-muted)' }}>{t('about.text')}</p>
    </Dialog>
  );
}
