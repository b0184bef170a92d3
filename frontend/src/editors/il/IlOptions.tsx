import { useEffect } from 'react';
import { useText } from '@/i18n';
import { Checkbox, Field } from '@/ui/Field';
import { ilSettings } from './settings';

/** Optional columns of the table of IL (FBD-41, IL-01). */
export function IlOptions() {
  const t = useText();
  const { address, symbolComment, operandComment } = ilSettings.use();
  useEffect(() => void ilSettings.load(), []);
  return (
    <Field row label={t('il.columns')}>
      {() => (
        <>
          <Checkbox checked={address} onChecked={(on) => ilSettings.change({ address: on })}>
            {t('il.showAddress')}
          </Checkbox>
          <Checkbox checked={symbolComment} onChecked={(on) => ilSettings.change({ symbolComment: on })}>
            {t('il.showSymbolComment')}
          </Checkbox>
          <Checkbox checked={operandComment} onChecked={(on) => ilSettings.change({ operandComment: on })}>
            {t('il.showOperandComment')}
          </Checkbox>
        </>
      )}
    </Field>
  );
}
