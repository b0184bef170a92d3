import { chooseLanguage, chooseTheme, usePreferences, type ThemeChoice } from '@/app/preferences';
import { IlOptions } from '@/editors/il/IlOptions';
import { FormatOptions } from '@/editors/st/FormatOptions';
import { useLanguage, useText, type Language } from '@/i18n';
import { guard } from '../notices';
import { Button } from '../ui/Button';
import { Dialog } from '../ui/Dialog';
import { Field, Select } from '../ui/Field';
import styles from './OptionsDialog.module.css';

const THEMES: readonly ThemeChoice[] = ['light', 'dark', 'system'];

/** Language, theme, how ST is formatted, what the table of IL shows; every choice acts at once. */
export function OptionsDialog({ close }: { close: () => void }) {
  const t = useText();
  const language = useLanguage();
  const theme = usePreferences((state) => state.theme);
  return (
    <Dialog title={t('command.options')} onClose={close} footer={<Button onClick={close}>{t('action.close')}</Button>}>
      <Field row label={t('language.label')}>
        {(attributes) => (
          <Select<Language>
            {...attributes}
            value={language}
            choices={[
              { value: 'en', text: 'English' },
              { value: 'zh', text: '简体中文' },
            ]}
            onValue={(choice) => void guard(() => chooseLanguage(choice))}
          />
        )}
      </Field>
      <Field row label={t('theme.label')}>
        {(attributes) => (
          <Select<ThemeChoice>
            {...attributes}
            value={theme}
            choices={THEMES.map((choice) => ({ value: choice, text: t(`theme.${choice}`) }))}
            onValue={(choice) => void guard(() => chooseTheme(choice))}
          />
        )}
      </Field>
      <h3 className={styles.group}>{t('format.title')}</h3>
      <FormatOptions />
      <h3 className={styles.group}>{t('il.options')}</h3>
      <IlOptions />
    </Dialog>
  );
}
