/**
 * Components whose modules are fetched when they are first shown, or while the user does nothing.
 *
 * React keeps what it shows in place of a component that is being fetched for at least 300 ms, even when the module
 * comes at once. A component whose module is there already is drawn without that pause.
 */
import { lazy, useState, type ComponentType, type FunctionComponent } from 'react';

const beforehand = new Set<() => Promise<unknown>>();

/** A component of a module of its own. */
export function onDemand<P extends object>(load: () => Promise<{ default: ComponentType<P> }>): FunctionComponent<P> {
  let loaded: ComponentType<P> | null = null;
  const fetch = async () => {
    const part = await load();
    loaded = part.default;
    return part;
  };
  const Fetched = lazy(fetch) as unknown as ComponentType<P>;
  fetchBeforehand(fetch);
  return function OnDemand(props: P) {
    // What has been drawn first stays: another component would begin anew.
    const [Part] = useState(() => loaded ?? Fetched);
    return <Part {...props} />;
  };
}

/** Something else that opens sooner when it has been fetched. */
export function fetchBeforehand(load: () => Promise<unknown>): void {
  beforehand.add(load);
}

const BEGIN_MS = 500;

/** Fetches all of it, one after the other, while the page has nothing else to do; returns how to stop. */
export function fetchWhileIdle(): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let idle = 0;
  let stopped = false;
  const next = () => {
    const load = [...beforehand][0];
    if (load === undefined || stopped) return;
    beforehand.delete(load);
    // Who opens it in earnest is told why it cannot be fetched.
    load().then(plan, plan);
  };
  const plan = () => {
    // Safari has no idle callbacks.
    if (typeof requestIdleCallback === 'function') idle = requestIdleCallback(next);
    else timer = setTimeout(next, 50);
  };
  timer = setTimeout(plan, BEGIN_MS);
  return () => {
    stopped = true;
    clearTimeout(timer);
    if (typeof cancelIdleCallback === 'function') cancelIdleCallback(idle);
  };
}
