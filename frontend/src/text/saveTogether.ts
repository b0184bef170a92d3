/** Texts of several objects stored as one change of the project: all of them, or none. */
import { saveObjects, type ObjectContent } from '@/api/queries';
import type { TextDocument } from './documents';

/** Throws what the server refused the save with; then nothing is stored, and the texts are still changed. */
export async function saveTogether(
  projectId: string,
  documents: readonly TextDocument[],
  comment: string,
): Promise<void> {
  const contents: ObjectContent[] = [];
  let send = (): void => undefined;
  const collected = new Promise<void>((resolve) => {
    send = resolve;
  });
  const stored = collected.then(() => (contents.length === 0 ? [] : saveObjects(projectId, contents, comment)));
  const settled = documents.map((document) =>
    document.saveBy(async (base_revision, data) => {
      contents.push({ object_id: document.objectId, base_revision, data });
      const saved = (await stored).find((object) => object.id === document.objectId);
      if (saved === undefined) throw new Error(`'${document.name}' is missing in the answer`);
      return saved;
    }),
  );
  send();
  await Promise.all(settled);
  await stored;
}
