import { Languages, Moon, Sun } from 'lucide-react';
import type { ReactNode } from 'react';
import { useLanguage, useText } from '@/i18n';
import { TappetMark } from '@/icons/TappetMark';
import { Button, IconButton } from '@/ui/Button';
import { chooseLanguage, chooseTheme, usePreferences } from '@/session/preferences';
import styles from './Login.module.css';

/** The page around a sign-in form: the mark, language and theme. */
export function LoginFrame({ title, text, children }: { title: string; text: ReactNode; children: ReactNode }) {
  return (
    <div className={styles.page}>
      <div className={styles.top}>
        <PreferenceButtons />
      </div>
      <main className={styles.card}>
        <div className={styles.brand}>
          <TappetMark size={26} />
          Tappet
        </div>
        <h1 className={styles.title}>{title}</h1>
        <p className={styles.text}>{text}</p>
        {children}
      </main>
    </div>
  );
}

/** Language and theme by one click each, for pages without the user menu. */
function PreferenceButtons() {
  const t = useText();
  const language = useLanguage();
  const shown = usePreferences((state) => state.shown);
  return (
    <>
      <Button variant="quiet" icon={Languages} onClick={() => void chooseLanguage(language === 'en' ? 'zh' : 'en')}>
        {language === 'en' ? '中文' : 'English'}
      </Button>
      <IconButton
        icon={shown === 'dark' ? Sun : Moon}
        label={t(shown === 'dark' ? 'theme.toLight' : 'theme.toDark')}
        onClick={() => void chooseTheme(shown === 'dark' ? 'light' : 'dark')}
      />
    </>
  );
}
