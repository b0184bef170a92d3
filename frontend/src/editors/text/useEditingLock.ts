import { useEffect } from 'react';
import type { ObjectSummary } from '@/api/types';
import { t } from '@/i18n';
import { useObjectSession } from '@/online/useObjectSession';
import { useProject } from '@/project/openProject';
import { useSession } from '@/session/session';
import type { CodeEditor } from '@/text/CodePane';
import { atLeast } from '@/workbench/rights';
import { endOnlineEdit, keepKeys, useOnlineEdit } from './onlineEdit';

/**
 * Whether the text may not be edited now. While logged in it is locked until the user says that it shall change:
 * the change then takes effect with the next online change.
 */
export function useEditingLock(object: ObjectSummary, editor: CodeEditor | null): boolean {
  const role = useSession((state) => state.user?.role ?? null);
  const projectId = useProject((state) => state.projectId);
  const session = useObjectSession(projectId, object);
  const online = session !== null;
  const unlocked = useOnlineEdit((state) => state.unlocked.has(object.id));
  const asked = useOnlineEdit((state) => state.questions.has(object.id));
  const engineer = atLeast(role, 'engineer');
  const locked = online && !unlocked;

  useEffect(() => {
    if (!online && (unlocked || asked)) endOnlineEdit(object.id);
  }, [online, unlocked, asked, object.id]);

  useEffect(() => {
    if (editor === null) return;
    editor.updateOptions({ readOnlyMessage: { value: engineer ? t('st.lockedOnline') : t('st.lockedRole') } });
    if (engineer && locked) return keepKeys(object.id, editor);
  }, [editor, engineer, locked, object.id]);

  return !engineer || locked;
}
