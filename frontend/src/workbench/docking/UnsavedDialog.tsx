import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';

export type UnsavedAnswer = 'save' | 'discard';

export function UnsavedDialog({ names, close }: { names: readonly string[]; close: (answer?: UnsavedAnswer) => void }) {
  const t = useText();
  return (
    <Dialog
      title={t('unsaved.title')}
      description={t('unsaved.text', { names: names.join(', ') })}
      onClose={() => close()}
      onSubmit={() => close('save')}
      footer={
        <>
          <Button variant="danger" onClick={() => close('discard')} style={{ marginRight: 'auto' }}>
            {t('unsaved.discard')}
          </Button>
          <Button onClick={() => close()}>{t('action.cancel')}</Button>
          <Button type="submit" variant="primary" data-autofocus>
            {t('action.save')}
          </Button>
        </>
      }
    />
  );
}
