import { useSyncExternalStore } from 'react';
import type { CncDocument } from './cncDocument';

/** Draws again with every change of the program and of what is known of it. */
export function useProgramVersion(program: CncDocument): number {
  return useSyncExternalStore(program.subscribe, () => program.version);
}
