/** Where the message window gets the quick fixes of a message from: the language client registers itself here. */
import type { Diagnostic } from '@/api/types';
import type { MenuEntry } from '@/ui/Menu';

/** `show` brings the place of the message into view; it runs before a fix is applied. */
export type QuickFixSource = (message: Diagnostic, show: () => void) => Promise<MenuEntry[]>;

let source: QuickFixSource | null = null;

export function setQuickFixSource(quickFixes: QuickFixSource): void {
  source = quickFixes;
}

export async function quickFixesOf(message: Diagnostic, show: () => void): Promise<MenuEntry[]> {
  return (await source?.(message, show)) ?? [];
}
