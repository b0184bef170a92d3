import { keys, queryClient } from '@/api/queries';
import type { Diagnostic, ObjectSummary } from '@/api/types';
import { t } from '@/i18n';
import { openObject } from '../docking/dock';
import { notify } from '@/ui/notices';
import { useProject } from '@/project/openProject';
import { hasPlace, presentMessages, setCurrent, useMessages } from './store';

/** Opens the object a message is about, at its place. Messages about libraries or the application have none,
 *  nor have the lines of `{text}` pragmas. Without `focus` the keyboard stays where it is. */
export function jumpTo(message: Diagnostic, focus = true): void {
  const { projectId } = useProject.getState();
  const objects = (projectId && queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId))) || [];
  const object = hasPlace(message) && objects.find((candidate) => candidate.id === message.object_id);
  if (!object) {
    notify({ tone: 'info', title: t('messages.noPlace'), text: message.object_path });
    return;
  }
  const { part, line, column, end_line, end_column } = message;
  openObject(object.id, object.name, {
    focus,
    place: {
      part: part ?? undefined,
      line: line ?? undefined,
      column: column ?? undefined,
      endLine: end_line ?? undefined,
      endColumn: end_column ?? undefined,
    },
  });
}

/** F4 and Shift+F4: the next or previous message that has a place, errors and warnings alike, around the end. */
export function stepMessage(by: 1 | -1): void {
  const { build, live, current } = useMessages.getState();
  const messages = presentMessages(build, live).filter(hasPlace);
  if (messages.length === 0) return;
  const at = current ? messages.indexOf(current) : -1;
  const next = messages[at < 0 ? (by > 0 ? 0 : messages.length - 1) : (at + by + messages.length) % messages.length]!;
  setCurrent(next);
  jumpTo(next);
}
