/** What a text is called where Monaco names one: in the list of references and above its preview. */
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { t } from '@/i18n';
import { parsePartUri } from '@/project/partUri';
import { objectPath } from '@/project/tree';

interface Address {
  readonly path: string;
  toString: () => string;
}

/** Monaco's label service: the last part of an address, and the whole of it or of its folder. */
export const partLabels = {
  getUriBasenameLabel(uri: Address): string {
    const part = parsePartUri(uri.toString());
    if (part === null) return lastOf(uri.path);
    const name = lastOf(pathOf(part.projectId, part.objectId), '.');
    return `${name} – ${t(`doc.part.${part.part}`)}`;
  },
  /** The object's path, both for a text and for the folder its two texts seem to lie in. */
  getUriLabel(uri: Address): string {
    const [, projectId = '', objectId = ''] = uri.path.split('/');
    return pathOf(projectId, objectId) || uri.path;
  },
};

function lastOf(path: string, separator = '/'): string {
  return path.slice(path.lastIndexOf(separator) + 1);
}

function pathOf(projectId: string, objectId: string): string {
  return objectPath(queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId)) ?? [], objectId);
}
