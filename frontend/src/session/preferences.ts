/**
 * Theme and language: the user's choice, kept on the server; before login and without a choice, as the browser prefers.
 * The last choice is also kept in this browser, so that the login page looks right and nothing flashes at the start.
 */
import { create } from 'zustand';
import { api } from '@/api/client';
import { queryClient } from '@/api/queries';
import type { User } from '@/api/types';
import { setLanguage, type Language } from '@/i18n';
import { useSession } from './session';

export type ThemeChoice = 'light' | 'dark' | 'system';

interface Preferences {
  theme: ThemeChoice;
  /** What `theme` comes to on this machine. */
  shown: 'light' | 'dark';
}

const LOCAL_THEME = 'tappet.theme';
const LOCAL_LANGUAGE = 'tappet.language';

export const usePreferences = create<Preferences>(() => ({ theme: 'system', shown: 'light' }));

const darkSystem = () => matchMedia('(prefers-color-scheme: dark)');

function isTheme(value: unknown): value is ThemeChoice {
  return value === 'light' || value === 'dark' || value === 'system';
}

function isLanguage(value: unknown): value is Language {
  return value === 'en' || value === 'zh';
}

function showTheme(theme: ThemeChoice): void {
  const shown = theme === 'system' ? (darkSystem().matches ? 'dark' : 'light') : theme;
  document.documentElement.dataset.theme = shown;
  usePreferences.setState({ theme, shown });
}

function remember(key: string, value: string): void {
  try {
    localStorage.setItem(key, value);
  } catch {
    // Private windows may refuse storage; then the choice lasts as long as the page.
  }
}

function remembered(key: string): string | null {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}

/** Before anything is drawn: what this browser remembers, else what it prefers. */
export async function startPreferences(): Promise<void> {
  const theme = remembered(LOCAL_THEME);
  showTheme(isTheme(theme) ? theme : 'system');
  darkSystem().addEventListener('change', () => showTheme(usePreferences.getState().theme));
  const language = remembered(LOCAL_LANGUAGE);
  await setLanguage(isLanguage(language) ? language : navigator.language.startsWith('zh') ? 'zh' : 'en');
}

/** After login: what the account prefers. */
export async function adoptPreferences(user: User): Promise<void> {
  if (isTheme(user.theme)) {
    remember(LOCAL_THEME, user.theme);
    showTheme(user.theme);
  }
  if (isLanguage(user.language)) {
    remember(LOCAL_LANGUAGE, user.language);
    await setLanguage(user.language);
  }
}

export async function chooseTheme(theme: ThemeChoice): Promise<void> {
  remember(LOCAL_THEME, theme);
  showTheme(theme);
  if (useSession.getState().user) await saveSetting('theme', theme);
}

export async function chooseLanguage(language: Language): Promise<void> {
  remember(LOCAL_LANGUAGE, language);
  await setLanguage(language);
  if (useSession.getState().user) await saveSetting('language', language);
}

/** A personal setting kept on the server; null when it was never saved. Another version may have stored it. */
export function loadSetting(key: string): Promise<unknown> {
  return queryClient.fetchQuery({
    queryKey: ['settings', key],
    queryFn: () => api.get('/api/v1/me/settings/{key}', { params: { path: { key } } }),
    staleTime: 0,
  });
}

/** With `keepalive` the request outlives the page; browsers take up to 64 KiB so. */
export async function saveSetting(key: string, value: unknown, keepalive = false): Promise<void> {
  await api.put('/api/v1/me/settings/{key}', { params: { path: { key } }, body: value, keepalive });
}

/** A list of names or ids as a setting; null where it is none. */
export async function loadNames(key: string): Promise<readonly string[] | null> {
  const stored = await loadSetting(key);
  return Array.isArray(stored) ? stored.filter((one) => typeof one === 'string') : null;
}
