import {
  ArrowLeftRight,
  ArrowLeftToLine,
  ArrowRightToLine,
  ChevronDown,
  ChevronRight,
  Pi,
  Variable,
} from 'lucide-react';
import { RowMark } from '@/bookmarks/RowMark';
import { useText } from '@/i18n';
import styles from './OnlineTable.module.css';
import { isExpandable, type OnlineRow } from './treeRows';
import { useLiveItem } from './useLive';

interface NameCellProps {
  row: OnlineRow;
  runtimeId: string | null;
  onToggle: (row: OnlineRow) => void;
}

const INDENT_PX = 16;

/** Name with its place in the tree, an arrow to open, and an icon for input, output and others (DECL-46). */
export function NameCell({ row, runtimeId, onToggle }: NameCellProps) {
  const t = useText();
  const item = useLiveItem(runtimeId, row.expression);
  const error = row.valueless !== true && (row.kind === undefined || row.kind === 'error') ? item?.error : undefined;
  const expandable = isExpandable(row);
  if (row.expression === '') return <span className={styles.placeholder}>{t('watch.newLine')}</span>;
  const Arrow = row.open === true ? ChevronDown : ChevronRight;
  return (
    <span className={styles.name} style={{ paddingLeft: row.depth * INDENT_PX }}>
      {expandable ? (
        <button
          type="button"
          className={styles.arrow}
          tabIndex={-1}
          aria-label={t(row.open === true ? 'online.collapse' : 'online.expand')}
          onPointerDown={(event) => event.stopPropagation()}
          onDoubleClick={(event) => event.stopPropagation()}
          onClick={() => onToggle(row)}
        >
          <Arrow size={14} />
        </button>
      ) : (
        <span className={styles.arrow} />
      )}
      <SectionIcon section={row.section ?? item?.section} flags={row.flags ?? item?.flags} />
      {row.bookmarked === true && (
        <span className={styles.icon}>
          <RowMark />
        </span>
      )}
      <span className={error ? styles.invalid : undefined} title={error ?? undefined}>
        {row.label}
      </span>
    </span>
  );
}

function SectionIcon({ section, flags }: { section?: string; flags?: readonly string[] }) {
  const t = useText();
  const look =
    flags?.includes('CONSTANT') === true
      ? { Icon: Pi, name: t('online.section.constant') }
      : section === 'VAR_INPUT'
        ? { Icon: ArrowRightToLine, name: t('online.section.input') }
        : section === 'VAR_OUTPUT'
          ? { Icon: ArrowLeftToLine, name: t('online.section.output') }
          : section === 'VAR_IN_OUT'
            ? { Icon: ArrowLeftRight, name: t('online.section.inout') }
            : { Icon: Variable, name: t('online.section.variable') };
  return (
    <span className={styles.icon} title={look.name} data-section={section}>
      <look.Icon size={14} strokeWidth={1.6} />
    </span>
  );
}
