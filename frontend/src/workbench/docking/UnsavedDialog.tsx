import { listed, useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { FormDialog } from '@/ui/FormDialog';

export type UnsavedAnswer = 'save' | 'discard';

export function UnsavedDialog({ names, close }: { names: readonly string[]; close: (answer?: UnsavedAnswer) => void }) {
  const t = useText();
  return (
    <FormDialog
      title={t('unsaved.title')}
      description={t('unsaved.text', { names: listed(names) })}
      onClose={() => close()}
      onSubmit={() => close('save')}
      action={t('action.save')}
      focusAction
      aside={
        <Button variant="danger" onClick={() => close('discard')} style={{ marginRight: 'auto' }}>
          {t('unsaved.discard')}
        </Button>
      }
    />
  );
}
