import { useState } from 'react';
import { refusalOf } from './notices';

/** Runs what a form asks of the server. When the server refuses, the form stays and shows why. */
export function useRefusal(): [refused: string | null, ask: (act: () => Promise<void>) => Promise<void>] {
  const [refused, setRefused] = useState<string | null>(null);
  const ask = async (act: () => Promise<void>) => {
    try {
      await act();
    } catch (error) {
      setRefused(refusalOf(error));
    }
  };
  return [refused, ask];
}
