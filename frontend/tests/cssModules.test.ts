import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { expect, it } from 'vitest';

const SOURCES = resolve(import.meta.dirname, '../src');
const IMPORT = /^import (\w+) from '([^']+\.module\.css)';$/gm;

/** Classes that a style sheet names. */
function classesOf(path: string): Set<string> {
  return new Set([...readFileSync(path, 'utf-8').matchAll(/\.([A-Za-z_][\w-]*)/g)].map((found) => found[1]!));
}

/** `file: class` of each class that a file names and its style sheet does not have. */
function unknownClasses(path: string): string[] {
  const text = readFileSync(path, 'utf-8');
  return [...text.matchAll(IMPORT)].flatMap(([, name, sheet]) => {
    const file = sheet!.startsWith('@/') ? join(SOURCES, sheet!.slice(2)) : resolve(dirname(path), sheet!);
    const known = classesOf(file);
    const used = text.matchAll(new RegExp(`(?<![\\w.'"])${name!}(?:\\.(\\w+)|\\['([^']+)'\\])`, 'g'));
    const unknown = [...used].map((found) => found[1] ?? found[2]!).filter((each) => !known.has(each));
    return [...new Set(unknown)].map((each) => `${path.slice(SOURCES.length + 1)}: ${each}`);
  });
}

it('style sheets have every class that is used', () => {
  const files = readdirSync(SOURCES, { recursive: true, encoding: 'utf-8' }).filter((name) => /\.tsx?$/.test(name));
  expect(files.flatMap((name) => unknownClasses(join(SOURCES, name)))).toEqual([]);
});
