import { useSession } from '@/session/session';
import { useText } from '@/i18n';
import { useObjects } from '@/api/queries';
import { usePresence } from '../events';
import { useProject } from '@/project/openProject';
import { Tooltip } from '@/ui/Tooltip';
import styles from './MenuBar.module.css';
import { initials } from './UserMenu';

/** Others who have this project open, and what they look at. */
export function OtherUsers() {
  const t = useText();
  const me = useSession((state) => state.user?.username);
  const projectId = useProject((state) => state.projectId);
  const users = usePresence((state) => state.users);
  const { data: objects } = useObjects(projectId);
  const others = new Map<string, string | null>();
  for (const user of users) if (user.username !== me) others.set(user.username, user.object_id);
  if (others.size === 0) return null;
  return (
    <div className={styles.people} role="list" aria-label={t('presence.label')}>
      {[...others].map(([name, objectId]) => {
        const at = objects?.find((object) => object.id === objectId);
        return (
          <Tooltip key={name} text={name} detail={at && t('presence.at', { object: at.name })}>
            <span className={styles.person} role="listitem" tabIndex={0} aria-label={name}>
              {initials(name)}
            </span>
          </Tooltip>
        );
      })}
    </div>
  );
}
