import { useEffect } from 'react';
import { create } from 'zustand';
import type { ObjectSummary } from '@/api/types';
import { useSession } from '@/session/session';
import { t } from '@/i18n';
import { useObjectSession } from '@/online/useObjectSession';
import { confirm } from '@/ui/dialogs';
import { useProject } from '@/project/openProject';
import { atLeast } from '@/workbench/rights';
import type { CodeEditor } from '@/text/CodePane';

/** Objects the user has begun to edit while logged in. */
const useUnlocked = create<{ objects: ReadonlySet<string> }>(() => ({ objects: new Set() }));

/**
 * Whether the text may not be edited now. While logged in it is locked until the user says that it shall change:
 * the change then takes effect with the next online change.
 */
export function useEditingLock(object: ObjectSummary, editor: CodeEditor | null): boolean {
  const role = useSession((state) => state.user?.role ?? null);
  const projectId = useProject((state) => state.projectId);
  const session = useObjectSession(projectId, object);
  const online = session !== null;
  const unlocked = useUnlocked((state) => state.objects.has(object.id));
  const engineer = atLeast(role, 'engineer');
  const locked = online && !unlocked;

  useEffect(() => {
    if (online || !unlocked) return;
    useUnlocked.setState(({ objects }) => ({ objects: new Set([...objects].filter((id) => id !== object.id)) }));
  }, [online, unlocked, object.id]);

  useEffect(() => {
    if (editor === null) return;
    editor.updateOptions({ readOnlyMessage: { value: engineer ? t('st.lockedOnline') : t('st.lockedRole') } });
    if (!engineer || !locked) return;
    const subscription = editor.onDidAttemptReadOnlyEdit(
      () => void unlockForEditing(object).then(() => editor.focus()),
    );
    return () => subscription.dispose();
  }, [editor, engineer, locked, object]);

  return !engineer || locked;
}

let asking = false;

/** Asks whether the object shall be edited while logged in; true when it may be from now on. */
export async function unlockForEditing(object: ObjectSummary): Promise<boolean> {
  if (useUnlocked.getState().objects.has(object.id)) return true;
  if (asking) return false;
  asking = true;
  const yes = await confirm({
    title: t('st.unlockTitle', { name: object.name }),
    text: t('st.unlockText'),
    action: t('st.unlock'),
  }).finally(() => {
    asking = false;
  });
  if (yes) useUnlocked.setState(({ objects }) => ({ objects: new Set([...objects, object.id]) }));
  return yes;
}
