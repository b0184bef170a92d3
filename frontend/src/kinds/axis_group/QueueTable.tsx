import { useText } from '@/i18n';
import { numberText } from '@/editors/form/numbers';
import { useFlag, useLiveNumber } from '@/online/useLive';
import { Empty } from '@/ui/Empty';
import { useShown } from '../axis/live';
import styles from './AxisGroup.module.css';
import { blockName, remaining, slotsOf } from './queue';

interface QueueProps {
  runtimeId: string;
  /** Path of the group. */
  group: string;
  head: number;
  commands: number;
}

/** The information queue: the running command first (AG-42). The page watches its values. */
export function QueueTable({ runtimeId, group, head, commands }: QueueProps) {
  const t = useText();
  if (commands === 0) return <Empty title={t('axisGroup.queueEmpty')} text={t('axisGroup.queueEmptyText')} />;
  return (
    <div className={styles.scroll}>
      <table className={styles.table} aria-label={t('axisGroup.queue')}>
        <thead>
          <tr>
            <th>{t('axisGroup.instance')}</th>
            <th>{t('axisGroup.block')}</th>
            <th>{t('axisGroup.mode')}</th>
            <th className={styles.number}>vStart [u/s]</th>
            <th className={styles.number}>vEnd [u/s]</th>
            <th className={styles.number}>{t('axisGroup.remaining')} [u]</th>
            <th>{t('axisGroup.progress')}</th>
          </tr>
        </thead>
        <tbody>
          {slotsOf(head, commands).map((slot, place) => (
            <QueueRow
              key={place}
              runtimeId={runtimeId}
              group={group}
              command={`${group}.CommandQueue[${slot}]`}
              running={place === 0}
            />
          ))}
        </tbody>
      </table>
    </div>
  );
}

interface RowProps {
  runtimeId: string;
  group: string;
  command: string;
  /** It is at the head. */
  running: boolean;
}

function QueueRow({ runtimeId, group, command, running }: RowProps) {
  const t = useText();
  const instance = useShown(runtimeId, `${command}.sInstance`);
  const code = useLiveNumber(runtimeId, `${command}.wTypeId`);
  const kind = useShown(runtimeId, `${command}.eKind`);
  const mode = useShown(runtimeId, `${command}.BufferMode`);
  const start = useLiveNumber(runtimeId, `${command}.vStart`);
  const end = useLiveNumber(runtimeId, `${command}.vEnd`);
  const length = useLiveNumber(runtimeId, `${command}.stPath.fLength`);
  const position = useLiveNumber(runtimeId, `${group}.fPathPosition`) ?? 0;
  const active = useFlag(runtimeId, `${command}.Active`);
  const busy = useFlag(runtimeId, `${command}.Busy`);
  const left = length === null ? null : remaining(length, position, running);
  const corner = kind === 'Bend';
  return (
    <tr data-active={active}>
      <td className="code">{instance?.replace(/^'|'$/g, '') || '–'}</td>
      <td className="code">{corner ? t('axisGroup.corner') : code === null ? '–' : blockName(code)}</td>
      <td className="code">{mode ?? '–'}</td>
      <td className={`${styles.number} digits`}>{shown(start)}</td>
      <td className={`${styles.number} digits`}>{shown(end)}</td>
      <td className={`${styles.number} digits`}>{shown(left)}</td>
      <td>{t(active ? 'axisGroup.active' : busy ? 'axisGroup.busy' : 'axisGroup.aborted')}</td>
    </tr>
  );
}

function shown(value: number | null): string {
  return value === null ? '–' : numberText(Math.round(value * 1000) / 1000);
}
