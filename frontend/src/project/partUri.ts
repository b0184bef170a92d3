/** Addresses of the text parts of objects, in Monaco and in the Language Server Protocol. */

/** A text of an object. */
export type Part = 'declaration' | 'implementation';

/** Address of a part. */
export function partUri(projectId: string, objectId: string, part: Part): string {
  return `tappet:/${projectId}/${objectId}/${part}`;
}

export interface PartAddress {
  readonly projectId: string;
  readonly objectId: string;
  readonly part: Part;
}

const PART_URI = /^tappet:\/+([^/]+)\/([^/]+)\/(declaration|implementation)$/;

/** Takes `tappet:/<project>/<object>/<part>` apart; null for any other address. */
export function parsePartUri(uri: string): PartAddress | null {
  const match = PART_URI.exec(uri);
  if (match === null) return null;
  const [, projectId = '', objectId = '', part] = match;
  return { projectId, objectId, part: part as Part };
}
