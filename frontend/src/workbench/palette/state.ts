import { create } from 'zustand';

export type PaletteMode = 'commands' | 'objects' | 'symbols' | 'members';

export const usePalette = create<{ mode: PaletteMode | null }>(() => ({ mode: null }));

/** What had the focus when the palette opened. */
let before: HTMLElement | null = null;

export function openPalette(mode: PaletteMode): void {
  if (usePalette.getState().mode === null)
    before = document.activeElement instanceof HTMLElement ? document.activeElement : null;
  usePalette.setState({ mode });
}

/** Gives the focus back to where it was; what was chosen runs after that, so that it may move it. */
export function closePalette(chosen?: () => void): void {
  usePalette.setState({ mode: null });
  requestAnimationFrame(() => {
    if (before?.isConnected && document.activeElement === document.body) before.focus();
    before = null;
    chosen?.();
  });
}
