/** Types of the API, made from its OpenAPI document: `npm run generate` writes them to `src/api/schema.ts`. */
import { readFileSync, writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import openapiTS, { astToString, COMMENT_HEADER } from 'openapi-typescript';
import ts from 'typescript';

const BLOB = ts.factory.createTypeReferenceNode('Blob');

/** Uploads and downloads, in the words of OpenAPI 3.1 and 3.0. */
const isFile = ({ contentMediaType, format }) => contentMediaType === 'application/octet-stream' || format === 'binary';

/** The text of the types. What has a default may be left out of a request; answers say what they always hold. */
export async function apiTypes(document) {
  const types = await openapiTS(document, {
    defaultNonNullable: false,
    transform: (schema) => (isFile(schema) ? BLOB : undefined),
  });
  return COMMENT_HEADER + astToString(types);
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) {
  const folder = new URL('./src/api/', import.meta.url);
  const document = JSON.parse(readFileSync(new URL('openapi.json', folder), 'utf8'));
  writeFileSync(new URL('schema.ts', folder), await apiTypes(document));
}
