// @vitest-environment happy-dom
import { beforeAll, describe, expect, it, vi } from 'vitest';

vi.mock('monaco-editor/editor/editor.worker?worker', () => ({ default: class {} }));
vi.mock('./theme', () => ({ followTheme: () => undefined }));

interface Registered {
  EditorExtensionsRegistry: { getEditorContributions: () => { id: string }[] };
}
const EXTENSIONS = 'monaco-editor/editor/browser/editorExtensions';

let contributions: string[] = [];

beforeAll(async () => {
  await import('./monaco');
  const { EditorExtensionsRegistry } = (await import(EXTENSIONS)) as Registered;
  contributions = EditorExtensionsRegistry.getEditorContributions().map((one) => one.id);
}, 60_000);

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
});
