import { existsSync, readdirSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';

const root = join(import.meta.dirname, '..');

/** Those of this room, and those beside kinds and languages. */
function tables(language: string): string[] {
  const folder = join(import.meta.dirname, language);
  const beside = ['kinds', 'editors'].flatMap((room) =>
    readdirSync(join(root, room)).map((name) => join(root, room, name, `${language}.json`)),
  );
  return [...readdirSync(folder).map((name) => join(folder, name)), ...beside.filter((file) => existsSync(file))];
}

function texts(language: string): Record<string, string> {
  const all: Record<string, string> = {};
  for (const file of tables(language)) {
    for (const [key, text] of Object.entries(JSON.parse(readFileSync(file, 'utf8')) as Record<string, string>)) {
      if (key in all) throw new Error(`${file}: '${key}' is defined twice`);
      all[key] = text;
    }
  }
  return all;
}

function sources(folder: string): string[] {
  return readdirSync(folder).flatMap((name) => {
    const path = join(folder, name);
    if (statSync(path).isDirectory()) return sources(path);
    return /\.tsx?$/.test(name) && !/\.test\.tsx?$/.test(name) ? [path] : [];
  });
}

const base = (key: string) => key.replace(/_(one|other)$/, '');
const values = (text: string) => [...text.matchAll(/{{\s*(\w+)/g)].map((match) => match[1]).sort();
const en = texts('en');
const zh = texts('zh');

describe('texts', () => {
  it('are there in both languages', () => {
    const keys = (all: Record<string, string>) => [...new Set(Object.keys(all).map(base))].sort();
    expect(keys(zh)).toEqual(keys(en));
  });

  it('name the same values in both languages', () => {
    for (const [key, text] of Object.entries(zh)) {
      const english = en[key];
      if (english !== undefined) expect(values(text), key).toEqual(values(english));
    }
  });

  it('say one of a thing in the singular', () => {
    // A value and a noun in the plural behind it. A text that is chosen by a count has its own form for one.
    const plural = /({{\w+}}|\b1) (?:(?!of |has |does |in )[a-z]+ )?([a-z]{2,}(?<!s)s)\b/;
    const verbs = [
      'has',
      'does',
      'requires',
      'exists',
      'was',
      'is',
      'needs',
      'begins',
      'comes',
      'runs',
      'becomes',
      'changes',
    ];
    const wrong = Object.entries(en).filter(([key, text]) => {
      const noun = plural.exec(key.endsWith('_one') ? text.replace('{{count}}', '1') : text)?.[2];
      return noun !== undefined && !verbs.includes(noun) && !(key.endsWith('_other') && base(key) + '_one' in en);
    });
    expect(wrong).toEqual([]);
  });

  it('are chosen by a count in all forms that the language has', () => {
    const forms = new Intl.PluralRules('en').resolvedOptions().pluralCategories;
    const counted = Object.keys(en).filter((key) => /_(one|other)$/.test(key));
    for (const key of counted) for (const form of forms) expect(en, key).toHaveProperty([`${base(key)}_${form}`]);
  });

  it('call a thing by one word in Chinese', () => {
    // Words that mean two things in English, by the keys of the other meaning.
    const other = new Set([
      'addObject.access',
      'axis.values',
      'cnc.lineCount',
      'cnc.path.kind.feed',
      'ruleLimit.parameters',
      'properties.access',
      'crossReferences.address',
      'exchange.all',
      'help.back',
      'properties.changed',
      'log.component',
      'tasks.status.created',
      'project.created',
      'decl.headerKind',
      'ruleGroup.S10',
      'application.source.never',
      'role.operator',
      'il.column.operator',
      'toolbar.reset',
      'tab.restore',
      'libraryDoc.returns',
      'exchange.save',
      'crossReferences.refresh',
      'crossReferences.busy',
      'ruleGroup.S13',
      'start.begin',
      'exchange.scope',
      'format.lower',
      'format.upper',
    ]);
    const words = new Map<string, Set<string>>();
    const plain = (text: string) => text.replace(/…$/, '').trim().toLowerCase();
    for (const [key, text] of Object.entries(en)) {
      const chinese = zh[key];
      // Names of what is filled in say in Chinese what it is.
      if (chinese === undefined || other.has(key) || key.startsWith('field.')) continue;
      words.set(plain(text), (words.get(plain(text)) ?? new Set()).add(plain(chinese)));
    }
    const several = [...words].filter(([, chinese]) => chinese.size > 1).map(([text, chinese]) => [text, ...chinese]);
    expect(several).toEqual([]);
  });

  it('are not empty', () => {
    for (const [key, text] of [...Object.entries(en), ...Object.entries(zh)]) expect(text.trim(), key).not.toBe('');
  });

  it('are all used', () => {
    // A key counts as used when its literal stands in a source, or a template literal `prefix.${...}` builds it.
    const code = sources(root)
      .map((path) => readFileSync(path, 'utf8'))
      .join('\n');
    const prefixes = [...code.matchAll(/`([a-zA-Z]+(?:\.[a-zA-Z]+)*\.)\$\{/g)].map((match) => match[1]!);
    const unused = [...new Set(Object.keys(en).map(base))].filter(
      (key) =>
        !code.includes(`'${key}'`) && !code.includes(`"${key}"`) && !prefixes.some((prefix) => key.startsWith(prefix)),
    );
    expect(unused).toEqual([]);
  });
});
