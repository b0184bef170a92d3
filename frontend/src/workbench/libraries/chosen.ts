import { create } from 'zustand';
import type { LibraryItem } from '@/api/types';

/** The library item whose documentation is shown. */
export const useChosenItem = create<{ library: string | null; item: LibraryItem | null }>(() => ({
  library: null,
  item: null,
}));

export function chooseItem(library: string, item: LibraryItem | null): void {
  useChosenItem.setState({ library, item });
}
