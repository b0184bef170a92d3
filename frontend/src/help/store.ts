/** The help panel of this window: what it shows, and the pages before. */
import { queryOptions } from '@tanstack/react-query';
import { create } from 'zustand';
import { api } from '@/api/client';
import { language, type Language } from '@/i18n';
import { showPanel } from '@/workbench/docking/dock';
import { showDocumentation } from '@/workbench/libraries/show';
import type { HelpEntry, HelpTarget } from './model';

interface HelpState {
  /** Pages gone through; the last one is shown. */
  pages: readonly HelpTarget[];
  search: string;
}

export const useHelp = create<HelpState>(() => ({ pages: [], search: '' }));

export function entriesQuery(of: Language = language()) {
  return queryOptions({
    queryKey: ['help', of],
    queryFn: () => api.get('/api/v1/help', { params: { query: { language: of } } }),
    staleTime: Infinity,
  });
}

export function pageQuery({ kind, name }: HelpTarget, of: Language) {
  const query = { language: of };
  return queryOptions({
    queryKey: ['help', of, kind, name],
    queryFn: () => {
      if (kind === 'word') return api.get('/api/v1/help/words/{word}', { params: { path: { word: name }, query } });
      if (kind === 'message')
        return api.get('/api/v1/help/messages/{code}', { params: { path: { code: name }, query } });
      return api.get('/api/v1/help/views/{name}', { params: { path: { name }, query } });
    },
    staleTime: Infinity,
  });
}

/** Shows a page beside the editors, which keep the focus. */
export function openHelp(target: HelpTarget): void {
  useHelp.setState(({ pages }) => {
    const last = pages.at(-1);
    const same = last?.kind === target.kind && last.name === target.name;
    return { pages: same ? pages : [...pages.slice(-49), target], search: '' };
  });
  showPanel('help', false);
}

/** Items of libraries have a panel of their own. */
export function openEntry(entry: HelpEntry): void {
  if (entry.library === null) openHelp(entry);
  else void showDocumentation(entry.library, entry.name);
}

export function helpBack(): void {
  useHelp.setState(({ pages }) => ({ pages: pages.slice(0, -1), search: '' }));
}
