// @vitest-environment happy-dom
import { expect, it, vi } from 'vitest';
import { loadMonaco } from './monacoLoader';

vi.mock('./monaco', () => ({ monaco: { languages: {} } }));

it('waits for the font of code, in which Monaco measures', async () => {
  let fontLoaded: () => void = () => undefined;
  const load = vi.fn(() => new Promise<void>((resolve) => (fontLoaded = resolve)));
  Object.defineProperty(document, 'fonts', { value: { load }, configurable: true });
  let ready = false;
  const loading = loadMonaco().then(() => (ready = true));
  await vi.dynamicImportSettled();
  expect(load).toHaveBeenCalledWith("13px 'JetBrains Mono'");
  expect(ready).toBe(false);
  fontLoaded();
  await loading;
  expect(ready).toBe(true);
});
