// @vitest-environment happy-dom
import { beforeAll, describe, expect, it, vi } from 'vitest';
import { ACTIONS } from '@/editors/st/actions';

vi.mock('monaco-editor/editor/editor.worker?worker', () => ({ default: class {} }));
vi.mock('./theme', () => ({ followTheme: () => undefined }));

interface Registered {
  EditorExtensionsRegistry: { getEditorContributions: () => { id: string }[] };
  CommandsRegistry: { getCommand: (id: string) => unknown };
}
const EXTENSIONS = 'monaco-editor/editor/browser/editorExtensions';
const COMMANDS = 'monaco-editor/platform/commands/common/commands';

let contributions: string[] = [];
let known: (id: string) => boolean;

beforeAll(async () => {
  await import('./monaco');
  const { EditorExtensionsRegistry } = (await import(EXTENSIONS)) as Registered;
  contributions = EditorExtensionsRegistry.getEditorContributions().map((one) => one.id);
  const { CommandsRegistry } = (await import(COMMANDS)) as Registered;
  known = (id) => CommandsRegistry.getCommand(id) !== undefined;
}, 60_000);

describe('the colours of IL', () => {
  it('are there without the language server', async () => {
    const { monaco } = await import('./monaco');
    const text = 'loop: LDN xStart\nST (* c *) s\nS.Run LD\nmark:\nJMPC mark';
    const words = monaco.editor
      .tokenize(text, 'iec-il')
      .map((tokens, line) =>
        tokens
          .filter((token) => token.type.startsWith('keyword'))
          .map((token) => /\w+/.exec(text.split('\n')[line]!.slice(token.offset))?.[0]),
      );
    expect(words).toEqual([['LDN'], ['ST'], [], [], ['JMPC']]);
  });
});

describe('the text editor', () => {
  it.each([
    'editor.contrib.suggestController',
    'editor.controller.parameterHints',
    'editor.contrib.contentHover',
    'editor.contrib.referencesController',
    'editor.contrib.renameController',
    'editor.contrib.findController',
    'editor.contrib.folding',
    'editor.contrib.wordHighlighter',
    'snippetController2',
  ])('has %s', (id) => expect(contributions).toContain(id));

  it.each(Object.entries(ACTIONS))('knows what %s runs', (_command, id) => expect(known(id)).toBe(true));
});
