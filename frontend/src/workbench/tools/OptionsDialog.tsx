import { Fragment } from 'react';
import { chooseLanguage, chooseTheme, usePreferences, type ThemeChoice } from '@/session/preferences';
import { useLanguage, useText, type Language } from '@/i18n';
import { guard } from '@/ui/notices';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Field, Select } from '@/ui/Field';
import { optionGroups } from './optionGroups';
import styles from './OptionsDialog.module.css';

const THEMES: readonly ThemeChoice[] = ['light', 'dark', 'system'];

/** Language, theme and what other rooms register; every choice acts at once. */
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
      {optionGroups().map(({ title, component: Options }) => (
        <Fragment key={title}>
          <h3 className={styles.group}>{t(title)}</h3>
          <Options />
        </Fragment>
      ))}
    </Dialog>
  );
}
