import { Activity, Camera, Download, FileSpreadsheet, ListPlus, Upload, X } from 'lucide-react';
import { useText } from '@/i18n';
import { NUMBER_FORMATS, type NumberFormat } from '@/text/settings';
import { IconButton } from '@/ui/Button';
import { Select } from '@/ui/Field';
import { DropdownMenu, type MenuEntry } from '@/ui/Menu';
import table from '../OnlineTable.module.css';
import { FileButton } from './FileButton';
import type { ListOptions } from './model';
import styles from './Watch.module.css';

interface WatchBarProps {
  online: boolean;
  empty: boolean;
  options: ListOptions;
  /** How many snapshots are shown. */
  snapshots: number;
  onOptions: (changes: Partial<ListOptions>) => void;
  onSnapshot: () => void;
  onForget: () => void;
  onCsv: () => void;
  onExport: () => void;
  onImport: (text: string) => void;
  /** What can be done with the list itself. */
  acts: () => readonly MenuEntry[];
}

/** Stands for the format of the editors: a choice of the list needs a value. */
const GENERAL = 'general';

/** What can be done with a whole watch list. */
export function WatchBar(props: WatchBarProps) {
  const t = useText();
  const empty = props.empty ? t('watch.empty') : null;
  const offline = props.online ? null : t('reason.notLoggedIn');
  return (
    <div className={table.bar}>
      <IconButton
        small
        icon={Camera}
        label={t('watch.snapshot')}
        disabledReason={offline ?? empty}
        onClick={props.onSnapshot}
      />
      <IconButton
        small
        icon={FileSpreadsheet}
        label={t('watch.saveCsv')}
        disabledReason={props.snapshots > 0 ? null : t('watch.noSnapshot')}
        onClick={props.onCsv}
      />
      <IconButton
        small
        icon={X}
        label={t('watch.forget')}
        disabledReason={props.snapshots > 0 ? null : t('watch.noSnapshot')}
        onClick={props.onForget}
      />
      <IconButton
        small
        icon={Activity}
        label={t('watch.history')}
        pressed={props.options.history}
        onClick={() => props.onOptions({ history: !props.options.history })}
      />
      <IconButton small icon={Download} label={t('watch.export')} disabledReason={empty} onClick={props.onExport} />
      <FileButton icon={Upload} label={t('watch.import')} disabledReason={null} onText={props.onImport} />
      <DropdownMenu trigger={<IconButton small icon={ListPlus} label={t('watch.lists')} />} entries={props.acts} />
      <span className={styles.push}>
        <Select<NumberFormat | typeof GENERAL>
          className={styles.format}
          label={t('online.format')}
          value={props.options.format ?? GENERAL}
          choices={[
            { value: GENERAL, text: t('watch.formatGeneral') },
            ...NUMBER_FORMATS.map((value) => ({ value, text: t(`online.format.${value}`) })),
          ]}
          onValue={(format) => props.onOptions({ format: format === GENERAL ? null : format })}
        />
      </span>
    </div>
  );
}
