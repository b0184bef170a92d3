/**
 * How applications relate to what their controllers run, as last asked: before a login as well as while it lasts. The
 * status bar, the panel of changes and the login speak of the same answer.
 */
import { create } from 'zustand';
import type { LoginAnswer } from '@/api/types';

export interface KnownRelation {
  runtimeId: string;
  answer: LoginAnswer;
}

export const useKnownRelation = create<{ known: Readonly<Record<string, KnownRelation>> }>(() => ({ known: {} }));

export function relationKnown(applicationId: string, runtimeId: string, answer: LoginAnswer): void {
  useKnownRelation.setState(({ known }) => ({ known: { ...known, [applicationId]: { runtimeId, answer } } }));
}

/** The controller cannot be asked, or the text does not build. */
export function relationUnknown(applicationId: string): void {
  useKnownRelation.setState(({ known }) => {
    const { [applicationId]: _gone, ...rest } = known;
    return { known: rest };
  });
}

export function forgetRelations(): void {
  useKnownRelation.setState({ known: {} });
}
