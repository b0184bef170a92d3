import type { ReactNode } from 'react';
import { createPortal } from 'react-dom';

/** Buttons of a page of a dialog, in the foot of the dialog. */
export function Footer({ place, children }: { place: HTMLElement | null; children: ReactNode }) {
  return place && createPortal(children, place);
}
