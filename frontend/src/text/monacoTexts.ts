/**
 * The language of Monaco's own texts. It looks most of them up when a widget is made, so those follow a switch; some it
 * reads once, while its modules are evaluated: they change when the page is loaded again, which a notice offers.
 */
import { language, onLanguageChange, t, type Language } from '@/i18n';
import { dismiss, notify } from '@/ui/notices';

/** Where Monaco looks its texts up, by number; English where there is no table. */
const place = globalThis as typeof globalThis & { _VSCODE_NLS_MESSAGES?: unknown };
/** The table that the language pack has put there: as a module it does so once. */
let chinese: unknown;
let readOnce: Language = 'en';

/** Puts the texts of the present language in place. */
export async function loadEditorTexts(): Promise<void> {
  if (language() === 'zh' && chinese === undefined) {
    await import('monaco-editor/nls/lang/zh-cn');
    chinese = place._VSCODE_NLS_MESSAGES;
  }
  place._VSCODE_NLS_MESSAGES = language() === 'zh' ? chinese : undefined;
}

/** To be called when Monaco is loaded, once. */
export function followLanguage(): void {
  readOnce = language();
  let notice: number | null = null;
  onLanguageChange(() => {
    void loadEditorTexts();
    if (notice !== null) dismiss(notice);
    notice = language() === readOnce ? null : offerReload();
  });
}

function offerReload(): number {
  return notify({
    tone: 'warn',
    title: t('text.languageStays'),
    text: t('text.languageStaysText'),
    action: { text: t('text.loadAgain'), run: () => location.reload() },
  });
}
