/** What the commands do with bookmarks: set one where the cursor stands, go from one to the next. */
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { parsePartUri } from '@/project/partUri';
import { panelPlace } from '@/text/focus';
import type { CommandContext } from '@/workbench/context';
import { openObject } from '@/workbench/docking/dock';
import { stepFrom, type Bookmark } from './model';
import { toggleBookmark, useBookmarks } from './store';

/** The line of the cursor in the editor in front; null where it shows no text. */
function bookmarkAtCursor(context: CommandContext): Bookmark | null {
  const place = context.activeEditor === null ? null : panelPlace(context.activeEditor.panelId);
  const model = place?.getModel();
  const line = place?.getPosition()?.lineNumber;
  const address = model == null ? null : parsePartUri(model.uri.toString());
  if (model == null || line === undefined || address === null) return null;
  return { objectId: address.objectId, part: address.part, line, text: model.getLineContent(line).trimEnd() };
}

export function toggleAtCursor(context: CommandContext): void {
  const here = bookmarkAtCursor(context);
  if (here !== null) toggleBookmark(here);
}

/** Goes to the bookmark behind or before the cursor; `within` the editor in front alone, or in the whole project. */
export function step(context: CommandContext, by: 1 | -1, within: boolean): void {
  const objects = queryClient.getQueryData<ObjectSummary[]>(keys.objects(context.projectId!)) ?? [];
  const { bookmarks } = useBookmarks.getState();
  const objectId = context.activeEditor?.objectId;
  const among = within ? bookmarks.filter((mark) => mark.objectId === objectId) : bookmarks;
  const next = stepFrom(among, objects, bookmarkAtCursor(context), by);
  if (next !== undefined) openBookmark(next, objects);
}

export function openBookmark(
  { objectId, part, line, text }: Bookmark,
  objects: readonly ObjectSummary[],
  focus = true,
): void {
  const object = objects.find(({ id }) => id === objectId);
  const column = text.length - text.trimStart().length + 1;
  if (object) openObject(objectId, object.name, { focus, place: { part, line, column } });
}
