// @vitest-environment happy-dom
import { expect, it, vi } from 'vitest';
import { registerLanguage, monacoLanguage } from '@/text/languages';
import { loadMonaco } from '@/text/monacoLoader';
import descriptor from '.';

vi.mock('monaco-editor/editor/editor.worker?worker', () => ({ default: class {} }));
vi.mock('@/text/theme', () => ({ followTheme: () => undefined }));

it('colours operators without the language server', async () => {
  registerLanguage(descriptor);
  const monaco = await loadMonaco();
  const text = 'loop: LDN xStart\nST (* c *) s\nS.Run LD\nmark:\nJMPC mark';
  const words = monaco.editor
    .tokenize(text, monacoLanguage(descriptor.language))
    .map((tokens, line) =>
      tokens
        .filter((token) => token.type.startsWith('keyword'))
        .map((token) => /\w+/.exec(text.split('\n')[line]!.slice(token.offset))?.[0]),
    );
  expect(words).toEqual([['LDN'], ['ST'], [], [], ['JMPC']]);
});
