import { useEffect } from 'react';
import { setHandlers, type Handlers } from './commands';

/**
 * Offers a view's own acts for delegated commands (`edit.undo`, `file.save` ...) while the view exists.
 * Pass a memoised object: each new one is registered again.
 */
export function useHandlers(panelId: string, handlers: Handlers | null): void {
  useEffect(() => {
    setHandlers(panelId, handlers);
    return () => setHandlers(panelId, null);
  }, [panelId, handlers]);
}
