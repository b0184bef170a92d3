import { useText } from '@/i18n';
import { Checkbox, Field } from '@/ui/Field';
import { setEditorSettings, useEditorSettings } from '@/text/settings';

/** Optional columns of the table of IL (FBD-41, IL-01). */
export function IlOptions() {
  const t = useText();
  const { ilAddress, ilSymbolComment, ilOperandComment } = useEditorSettings();
  return (
    <Field row label={t('il.columns')}>
      {() => (
        <>
          <Checkbox checked={ilAddress} onChecked={(on) => setEditorSettings({ ilAddress: on })}>
            {t('il.showAddress')}
          </Checkbox>
          <Checkbox checked={ilSymbolComment} onChecked={(on) => setEditorSettings({ ilSymbolComment: on })}>
            {t('il.showSymbolComment')}
          </Checkbox>
          <Checkbox checked={ilOperandComment} onChecked={(on) => setEditorSettings({ ilOperandComment: on })}>
            {t('il.showOperandComment')}
          </Checkbox>
        </>
      )}
    </Field>
  );
}
