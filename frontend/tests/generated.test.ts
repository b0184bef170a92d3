/** The types of the API are those that the OpenAPI document gives: run `make generate` after a change of the server. */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import openapiTS, { astToString, COMMENT_HEADER } from 'openapi-typescript';
import { expect, it } from 'vitest';

const folder = join(import.meta.dirname, '../src/api');

it('schema.ts is up to date with openapi.json', async () => {
  const document = JSON.parse(readFileSync(join(folder, 'openapi.json'), 'utf8')) as Parameters<typeof openapiTS>[0];
  const made = COMMENT_HEADER + astToString(await openapiTS(document));
  expect(readFileSync(join(folder, 'schema.ts'), 'utf8').trim() === made.trim(), 'run `npm run generate`').toBe(true);
});
