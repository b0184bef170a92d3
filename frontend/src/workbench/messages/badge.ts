import { useMemo } from 'react';
import { countOf, presentMessages, useMessages } from './store';

/** Number of errors on the Messages tab, else of warnings. */
export function useMessageBadge(): { text: string; tone: 'error' | 'warn' } | null {
  const { build, live } = useMessages();
  return useMemo(() => {
    const count = countOf(presentMessages(build, live));
    if (count.error) return { text: String(count.error), tone: 'error' };
    return count.warning ? { text: String(count.warning), tone: 'warn' } : null;
  }, [build, live]);
}
