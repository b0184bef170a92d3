// @vitest-environment happy-dom
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary, PlacementRule, Schemas } from '@/api/types';
import { useProject } from '@/project/openProject';
import { bodyOf, valueTokens, type LanguageBody } from '@/text/bodies';
import { monacoLanguage, textLanguages, type LanguageDescriptor } from '@/text/languages';
import { loadMonaco } from '@/text/monacoLoader';
import { useRegistry } from '@/workbench/commands';
import { addObject, clear, show, tab, until } from '../../tests/page';
import { registerLanguages } from './register';
import { registerBodies } from './textObject/bodies';

vi.mock('monaco-editor/editor/editor.worker?worker', () => ({ default: class {} }));
vi.mock('@/text/theme', () => ({ followTheme: () => undefined }));
// The server keeps no settings.
vi.stubGlobal('fetch', () => Promise.resolve(Response.json(null)));

const DESCRIPTORS = import.meta.glob<LanguageDescriptor>('../../tests/fixtures/languages/*/index.ts', {
  eager: true,
  import: 'default',
});
const BODIES = import.meta.glob<LanguageBody>('../../tests/fixtures/languages/*/body.tsx', {
  eager: true,
  import: 'default',
});

const links: ObjectSummary = {
  id: 'Links', kind: 'action', subkind: null, name: 'Links', parent_id: null, index: 0, revision: 1, excluded: false,
}; // prettier-ignore
const rule: PlacementRule = {
  kind: 'pou', places: ['pous_view.*'], once: false,
  naming: 'identifier', names: [], proposal: 'POU', first: '', unique: 'scope', subkinds: ['program'], languages: ['ST', 'CHAIN'],
}; // prettier-ignore
const chain = { name: 'CHAIN', title: 'Chain of elements' } as Schemas['BodyLanguage'];

beforeEach(() => {
  registerLanguages(DESCRIPTORS);
  registerBodies(BODIES);
  useProject.setState({ projectId: 'p' });
  queryClient.setQueryData(keys.languages, [chain]);
  queryClient.setQueryData(keys.objects('p'), [links]);
  const data = { language: 'CHAIN', implementation: 'pump -> valve' };
  queryClient.setQueryData(keys.object('p', 'Links'), { ...links, data });
});
afterEach(clear);

describe('a language whose folder is found by its place', () => {
  it('is offered by Add Object', async () => {
    const page = show(addObject([rule]));
    await until(page, () => page.querySelector('option[value=CHAIN]') !== null);
    expect(page.querySelector('option[value=CHAIN]')?.textContent).toBe('Chain of elements');
  });

  it('opens in its editor', async () => {
    const page = await until(show(tab(links)), (shown) => shown.querySelector('[aria-label=chain]') !== null);
    expect([...page.querySelectorAll('li')].map((link) => link.textContent)).toEqual(['pump', 'valve']);
  });

  it('has its colours, and the language server gets its texts', async () => {
    const monaco = await loadMonaco();
    const [line] = monaco.editor.tokenize('pump -> valve', monacoLanguage('CHAIN'));
    expect(line?.map(({ type }) => type)).toContain('keyword.link.toy-chain');
    expect(textLanguages()).toContain('toy-chain');
  });

  it('says what stands for values, and has commands', () => {
    expect(valueTokens('pump -> valve')).toHaveLength(1);
    expect(valueTokens('pump := valve')).toHaveLength(3);
    expect(useRegistry.getState().commands.has('chain.turn')).toBe(true);
  });
});

describe('a language without a folder', () => {
  it('opens as text', () => {
    registerBodies();
    expect(bodyOf('ROBOT').showsOthers).toBe(true);
    expect(monacoLanguage('ROBOT')).toBe(textLanguages()[0]);
  });
});
