import { readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { describe, expect, it } from 'vitest';
import { textOf } from '@/i18n';
import { allKinds, kindOf } from '@/project/kinds';
import { sources, SRC } from '../../tests/sources';

const folders = readdirSync(import.meta.dirname, { withFileTypes: true }).flatMap((entry) =>
  entry.isDirectory() ? [entry.name] : [],
);

/** Kinds that the server describes, by the models of their objects. */
function serverKinds(): string[] {
  const { components } = JSON.parse(readFileSync(join(SRC, 'api/openapi.json'), 'utf8')) as {
    components: { schemas: Record<string, { anyOf?: { $ref: string }[]; properties?: { kind?: { const?: string } } }> };
  };
  const of = components.schemas;
  return (of.ObjectDetail?.anyOf ?? []).flatMap(
    ({ $ref }) => of[$ref.split('/').at(-1)!]?.properties?.kind?.const ?? [],
  );
}

describe('folders of kinds', () => {
  it('describe the kind that they are called after', () => {
    expect(
      allKinds()
        .map(({ kind }) => kind)
        .sort(),
    ).toEqual([...folders].sort());
  });

  it('are there for every kind that the server itself has', () => {
    expect(serverKinds().length).toBeGreaterThan(10);
    for (const kind of serverKinds()) expect(kindOf(kind), kind).toBeDefined();
  });

  it('hold the texts of the kind and its subkinds', () => {
    for (const { kind, subkinds } of allKinds()) {
      expect(textOf(`kind.${kind}`), kind).not.toBeNull();
      expect(textOf(`about.${kind}`), kind).not.toBeNull();
      for (const [subkind, { short }] of Object.entries(subkinds ?? {})) {
        if (short !== undefined) expect(textOf(`subkind.${subkind}`), subkind).not.toBeNull();
      }
    }
  });
});

/**
 * Places that name a kind of object, or use its word for something else. Everything else asks the registry.
 * A new kind must not need a line here.
 */
const ALLOWED: Readonly<Record<string, string>> = {
  'text/theme.ts method property interface': 'token types of the Language Server Protocol',
  'lsp/client.ts method property interface': 'token types of the Language Server Protocol',
  'lsp/codeActions.ts method property': 'members that the language server proposes, by its names',
  'online/symbols.ts gvl': 'kind of a symbol of the runtime',
  'online/treeRows.ts gvl': 'kind of a symbol of the runtime',
  'online/item.ts interface': 'kind of a value of the runtime',
  'workbench/libraries/model.ts interface': 'kind of an item of a library',
  'workbench/debugger/HaltedStack.tsx pou': 'a column of the call stack',
  'workbench/online/CallStackPanel.tsx pou': 'a column of the call stack',
  'workbench/online/DownloadTerms.tsx persistent': 'a field of the answer to a login',
  'workbench/online/dialogs.tsx persistent': 'a field of the answer to a login',
  'workbench/online/exception.ts pou': 'a field of a frame of the call stack',
  'workbench/projectInfo/exampleText.ts axis_group': 'an example project',
  'project/kinds.ts application device folder script': 'roles in the tree',
};
const allowed = new Map(
  Object.keys(ALLOWED).map((line) => {
    const [file, ...words] = line.split(' ');
    return [file!, new Set(words)] as const;
  }),
);

/** Quoted words that are kinds; roles and arguments of functions that take a role are none. */
function namedKinds(code: string): string[] {
  const plain = code.replace(/(hasRole|ofRole|kindWithRole|named|nearest)\(([^()]|\([^()]*\))*\)/g, '');
  return [...new Set([...plain.matchAll(/(['"`])([a-z_]+)\1/g)].map((match) => match[2]!))].filter((word) =>
    folders.includes(word),
  );
}

describe('kinds', () => {
  it('are named in their folders only', () => {
    const found = sources(SRC, [import.meta.dirname]).flatMap((path) => {
      const file = relative(SRC, path);
      const words = namedKinds(readFileSync(path, 'utf8')).filter((word) => !allowed.get(file)?.has(word));
      return words.length > 0 ? [`${file} ${words.join(' ')}`] : [];
    });
    expect(found).toEqual([]);
  });

  it('would be found where they are named', () => {
    expect(namedKinds("const A = new Set(['pou', 'gvl']); hasRole(object, 'folder'); kind=\"dut\"")).toEqual([
      'pou',
      'gvl',
      'dut',
    ]);
  });
});
