// @vitest-environment happy-dom
import { Suspense, type FunctionComponent } from 'react';
import { flushSync } from 'react-dom';
import { createRoot } from 'react-dom/client';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import type * as OnDemand from './onDemand';

let demand: typeof OnDemand;

beforeEach(async () => {
  // The kinds have asked for theirs already.
  vi.resetModules();
  demand = await import('./onDemand');
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout'] });
  vi.stubGlobal('requestIdleCallback', (callback: () => void) => setTimeout(callback));
  vi.stubGlobal('cancelIdleCallback', (id: ReturnType<typeof setTimeout>) => clearTimeout(id));
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

/** What one drawing shows, before anything can be waited for. */
function drawn(Part: FunctionComponent): string {
  const place = document.createElement('div');
  const root = createRoot(place);
  flushSync(() =>
    root.render(
      <Suspense fallback="wait">
        <Part />
      </Suspense>,
    ),
  );
  const text = place.textContent;
  root.unmount();
  return text;
}

it('is drawn at once when its module has been fetched while nothing else was done', async () => {
  const load = vi.fn(() => Promise.resolve({ default: () => <>editor</> }));
  const Part = demand.onDemand(load);
  expect(drawn(Part)).toBe('wait');
  const Other = demand.onDemand(load);
  const stop = demand.fetchWhileIdle();
  await vi.runAllTimersAsync();
  expect(drawn(Part)).toBe('editor');
  expect(drawn(Other)).toBe('editor');
  stop();
});

it('fetches one thing after the other, goes on after a failure, and stops when told', async () => {
  const began: string[] = [];
  const thing = (name: string, end: () => Promise<unknown>) =>
    demand.fetchBeforehand(() => {
      began.push(name);
      return end();
    });
  let first: (() => void) | undefined;
  thing('first', () => new Promise<void>((resolve) => (first = resolve)));
  thing('second', () => Promise.reject(new Error('no network')));
  thing('third', () => Promise.resolve());
  const stop = demand.fetchWhileIdle();
  await vi.runAllTimersAsync();
  expect(began).toEqual(['first']);
  first?.();
  await vi.runAllTimersAsync();
  expect(began).toEqual(['first', 'second', 'third']);
  stop();
  thing('never', () => Promise.resolve());
  await vi.runAllTimersAsync();
  expect(began).not.toContain('never');
});
