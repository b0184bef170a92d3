import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { valuesOf } from '@/project/kinds';
import { timeText } from '../clock';
import { useOnline } from '../onlineSession';
import { toneOfApplication } from '../tones';
import { applicationOf, objectPath } from '@/project/tree';
import { pastText } from '../online/pastText';
import { ToneDot } from '../online/ToneDot';
import styles from './Panel.module.css';

interface OnlineStripeProps {
  object: ObjectSummary;
  objects: readonly ObjectSummary[];
  instance: string | null;
}

/** Online: names what the editor shows, in the colour of the runtime's state. Nothing while logged out. */
export function OnlineStripe({ object, objects, instance }: OnlineStripeProps) {
  const t = useText();
  const sessions = useOnline((state) => state.sessions);
  const application = applicationOf(objects, object.id);
  const tone = application && toneOfApplication(application.id, sessions);
  if (!application || !tone) return null;
  const { lostSince: since, past } = sessions[application.id]!;
  const path = instance ?? withoutPrefix(objectPath(objects, object.id), objectPath(objects, application.id));
  const isType = !instance && valuesOf(object) === 'instance';
  return (
    <div className={styles.stripe} data-tone={tone}>
      <ToneDot tone={tone} />
      <span className={styles.path}>{path}</span>
      {isType && <span>{t('online.implementation')}</span>}
      <span className={styles.state}>
        {tone === 'lost' && since
          ? t('online.lostSince', { time: timeText(since) })
          : tone === 'past' && past
            ? pastText(past, t)
            : t(`online.tone.${tone}`)}
      </span>
    </div>
  );
}

function withoutPrefix(path: string, prefix: string): string {
  return path.startsWith(`${prefix}.`) ? path.slice(prefix.length + 1) : path;
}
