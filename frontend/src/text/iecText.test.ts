// @vitest-environment happy-dom
import { expect, it, vi } from 'vitest';
import { IEC_TEXT } from './iecText';
import { loadMonaco } from './monacoLoader';

vi.mock('monaco-editor/editor/editor.worker?worker', () => ({ default: class {} }));
vi.mock('./theme', () => ({ followTheme: () => undefined }));

it('tells a call from a name before a comment, without the language server', async () => {
  const monaco = await loadMonaco();
  const kinds = (text: string) => monaco.editor.tokenize(text, IEC_TEXT)[0]!.map(({ type }) => type.split('.')[0]);
  expect(kinds('Start (IN)')[0]).toBe('function');
  expect(kinds('Aborted    (* needs a reset *)')).toEqual(['identifier', '', 'comment']);
});
