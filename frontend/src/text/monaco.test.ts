// @vitest-environment happy-dom
import { beforeAll, describe, expect, it, vi } from 'vitest';
import { ACTIONS } from '@/editors/text/actions';

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
