import { ESLint } from 'eslint';
import tseslint from 'typescript-eslint';
import { describe, expect, it } from 'vitest';
// @ts-expect-error: the configuration of ESLint is plain JavaScript.
import untyped from '../eslint.config.js';

const config = untyped as readonly { plugins?: Record<string, unknown> }[];
const rooms = config.filter((entry) => entry.plugins !== undefined && 'boundaries' in entry.plugins);

/** What the import rules say of one line in a file of a room; the types of the project are not needed for it. */
async function refusals(file: string, line: string): Promise<string[]> {
  const eslint = new ESLint({
    cwd: `${import.meta.dirname}/..`,
    overrideConfigFile: true,
    overrideConfig: rooms.map((entry) => ({ ...entry, languageOptions: { parser: tseslint.parser } })) as never,
  });
  const [result] = await eslint.lintText(line, { filePath: file });
  return result!.messages.map((message) => message.message);
}

describe('rooms', () => {
  it('may import from the rooms below them', async () => {
    expect(await refusals('src/app/App.tsx', "import { t } from '@/i18n';")).toEqual([]);
    expect(await refusals('src/kinds/task/model.ts', "import '@/editors/form/useDraft';")).toEqual([]);
  });

  it('may not import from the rooms above them', async () => {
    expect(await refusals('src/i18n/index.ts', "import { api } from '@/api/client';")).toEqual([
      "The room 'i18n' may not import from 'api': rooms import one way.",
    ]);
    expect(await refusals('src/workbench/run.ts', "import '../editors/register';")).toHaveLength(1);
    expect(await refusals('src/workbench/run.ts', "void import('@/lsp/session');")).toHaveLength(1);
    expect(await refusals('src/editors/st/acts.tsx', "import '../il/IlPane';")).toHaveLength(1);
    expect(await refusals('src/iec/lexer.ts', "import '@/editors/text/commands';")).toHaveLength(1);
  });

  it('hold every file', async () => {
    expect(await refusals('src/elsewhere/file.ts', 'export const x = 1;')).toHaveLength(1);
  });
});
