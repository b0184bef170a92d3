/** Short notices at the lower right: outcomes and refusals that belong to no place in a view. */
import { create } from 'zustand';
import { ApiError } from '@/api/client';
import { t } from '@/i18n';

export interface Notice {
  id: number;
  tone: 'info' | 'ok' | 'warn' | 'error';
  title: string;
  text?: string;
  action?: { text: string; run: () => void };
}

export const useNotices = create<{ notices: readonly Notice[] }>(() => ({ notices: [] }));
let last = 0;

const STAY_MS = { info: 5000, ok: 3500, warn: 9000, error: 12000 };

export function notify(notice: Omit<Notice, 'id'>): number {
  const id = ++last;
  // The same words twice replace each other instead of piling up.
  useNotices.setState(({ notices }) => ({
    notices: [
      ...notices.filter((other) => other.title !== notice.title || other.text !== notice.text),
      { ...notice, id },
    ].slice(-5),
  }));
  setTimeout(() => dismiss(id), STAY_MS[notice.tone]);
  return id;
}

export function dismiss(id: number): void {
  useNotices.setState(({ notices }) => ({ notices: notices.filter((notice) => notice.id !== id) }));
}

/** What went wrong and what to do, in the user's language where the status says it; the server's detail below. */
export function explain(error: unknown): { title: string; text?: string } {
  if (!(error instanceof ApiError))
    return { title: t('error.unexpected'), text: error instanceof Error ? error.message : String(error) };
  const text = error.problem.detail ?? error.problem.title;
  switch (error.status) {
    case 0:
      return { title: t('error.noServer'), text: t('error.noServerText') };
    case 401:
      return { title: t('error.signedOut'), text: t('error.signedOutText') };
    case 403:
      return { title: t('error.forbidden'), text };
    case 404:
      return { title: t('error.notFound'), text };
    case 409:
      return { title: t('error.conflict'), text };
    case 413:
      return { title: t('error.tooLarge'), text };
    case 422:
      return { title: t('error.refused'), text };
    case 507:
      return { title: t('error.diskFull'), text: t('error.diskFullText') };
    default:
      return { title: error.status >= 500 ? t('error.server') : error.problem.title, text };
  }
}

export function notifyError(error: unknown): void {
  notify({ tone: 'error', ...explain(error) });
}

/** Why the server refused what a form asked for, in its own words when it has answered. */
export function refusalOf(error: unknown): string {
  return error instanceof ApiError && error.status !== 0 ? error.message : explain(error).title;
}

/** Runs an act of a click or a command; a failure becomes a notice. Answers undefined then. */
export async function guard<Answer>(act: () => Promise<Answer>): Promise<Answer | undefined> {
  try {
    return await act();
  } catch (error) {
    notifyError(error);
    return undefined;
  }
}
