// @vitest-environment happy-dom
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { describe, expect, it } from 'vitest';
import { textOf } from '@/i18n';
import { bodyOf } from '@/text/bodies';
import { sources, SRC } from '../../tests/sources';
import { registerLanguages } from './register';
import { registerBodies } from './textObject/bodies';

/** Folders of this one that hold one of the files. */
function foldersWith(...files: string[]): string[] {
  return readdirSync(import.meta.dirname).filter((folder) =>
    files.some((file) => existsSync(join(import.meta.dirname, folder, file))),
  );
}
const folders = foldersWith('index.ts');

describe('folders of languages', () => {
  it('describe the language that they are called after', () => {
    const languages = registerLanguages().map(({ language }) => language);
    expect(languages.map((language) => language.toLowerCase()).sort()).toEqual(folders);
    for (const language of languages) expect(textOf(`language.${language}`), language).not.toBeNull();
  });

  it('show its bodies', () => {
    const bodies = registerBodies().map(({ language }) => language);
    expect(bodies.map((language) => language.toLowerCase()).sort()).toEqual(foldersWith('body.ts', 'body.tsx'));
    for (const language of bodies) expect(bodyOf(language).language).toBe(language);
    expect(registerBodies().filter(({ showsOthers }) => showsOthers)).toHaveLength(1);
  });
});

/** The languages that the server itself has. */
const SERVER = join(SRC, '../../backend/tappet/iec/languages');
const names = readdirSync(SERVER).flatMap((file) => {
  const name = /^([a-z]+)\.py$/.exec(file)?.[1];
  return name === undefined || name === 'language' ? [] : [name.toUpperCase()];
});

/** Names of languages in quotes, and imports from their folders. */
function named(code: string): string[] {
  const words = [...code.matchAll(/(['"`])([A-Z]+)\1/g)].flatMap(([, , word]) =>
    names.includes(word!) ? [word!] : [],
  );
  const imports = [...code.matchAll(/['"][^'"]*\/([a-z]+)\/[^'"/]+['"]/g)].flatMap(([, folder]) =>
    folders.includes(folder!) ? [folder!] : [],
  );
  return [...new Set([...words, ...imports])];
}

describe('languages', () => {
  it('are named in their folders only', () => {
    expect(names).toEqual(expect.arrayContaining(['ST', 'IL', 'SFC']));
    const own = folders.map((folder) => join(import.meta.dirname, folder));
    const found = sources(SRC, own).flatMap((path) => {
      const words = named(readFileSync(path, 'utf8'));
      return words.length > 0 ? [`${relative(SRC, path)} ${words.join(' ')}`] : [];
    });
    expect(found).toEqual([]);
  });

  it('would be found where they are named', () => {
    expect(named("const body = language === 'IL' ? 1 : 2; import x from '../st/acts';")).toEqual(['IL', 'st']);
  });
});
