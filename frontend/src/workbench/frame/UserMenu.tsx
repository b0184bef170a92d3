import { ChevronDown, KeyRound, Languages, LogOut, Moon, Settings, Sun, SunMoon, Users } from 'lucide-react';
import { chooseLanguage, chooseTheme, usePreferences, type ThemeChoice } from '@/session/preferences';
import { useSession } from '@/session/session';
import { language, useText, type Language } from '@/i18n';
import { findCommand } from '../commands';
import { guard } from '@/ui/notices';
import { runCommand } from '../run';
import { DropdownMenu, type MenuEntry } from '@/ui/Menu';
import styles from './MenuBar.module.css';

const THEME_ICONS = { light: Sun, dark: Moon, system: SunMoon };
const LANGUAGE_NAMES: Record<Language, string> = { en: 'English', zh: '简体中文' };

/** Who is signed in; language, theme, password, sign out. */
export function UserMenu() {
  const t = useText();
  const user = useSession((state) => state.user);
  if (!user) return null;

  const entries = (): MenuEntry[] => {
    const theme = usePreferences.getState().theme;
    const themes: MenuEntry[] = (['light', 'dark', 'system'] as ThemeChoice[]).map((choice) => ({
      kind: 'item',
      key: choice,
      text: t(`theme.${choice}`),
      icon: THEME_ICONS[choice],
      checked: theme === choice,
      run: () => void guard(() => chooseTheme(choice)),
    }));
    const languages: MenuEntry[] = (['en', 'zh'] as Language[]).map((choice) => ({
      kind: 'item',
      key: choice,
      text: LANGUAGE_NAMES[choice],
      checked: language() === choice,
      run: () => void guard(() => chooseLanguage(choice)),
    }));
    const command = (id: string, icon: typeof Sun): MenuEntry[] =>
      findCommand(id)
        ? [{ kind: 'item', key: id, text: t(findCommand(id)!.title), icon, run: () => void runCommand(id) }]
        : [];
    return [
      { kind: 'sub', key: 'theme', text: t('theme.label'), icon: THEME_ICONS[theme], entries: themes },
      { kind: 'sub', key: 'language', text: t('language.label'), icon: Languages, entries: languages },
      { kind: 'line', key: 'line-1' },
      ...command('tools.options', Settings),
      ...command('tools.password', KeyRound),
      ...(user.role === 'admin' ? command('tools.users', Users) : []),
      { kind: 'line', key: 'line-2' },
      ...command('file.signOut', LogOut),
    ];
  };

  return (
    <DropdownMenu
      align="end"
      entries={entries}
      trigger={
        <button type="button" className={styles.user} aria-label={t('user.menu', { name: user.username })}>
          <span className={styles.avatar} data-initials={initials(user.username)} aria-hidden />
          {user.username}
          <ChevronDown size={13} aria-hidden />
        </button>
      }
    />
  );
}

/** One or two letters; a Chinese name shows its last character. */
export function initials(name: string): string {
  if (/[^\p{ASCII}]/u.test(name)) return name.slice(-1);
  const parts = name.split(/[.\-_@ ]+/).filter(Boolean);
  return ((parts[0]?.[0] ?? '') + (parts[1]?.[0] ?? '')).toUpperCase();
}
