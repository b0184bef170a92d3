/** The types of the API are those that the OpenAPI document gives: run `make generate` after a change of the server. */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, it } from 'vitest';
// @ts-expect-error: what makes the types is plain JavaScript.
import { apiTypes as untyped } from '../apiTypes.js';

const apiTypes = untyped as (document: unknown) => Promise<string>;
const folder = join(import.meta.dirname, '../src/api');

it('schema.ts is up to date with openapi.json', async () => {
  const made = await apiTypes(JSON.parse(readFileSync(join(folder, 'openapi.json'), 'utf8')));
  expect(readFileSync(join(folder, 'schema.ts'), 'utf8').trim() === made.trim(), 'run `npm run generate`').toBe(true);
});
