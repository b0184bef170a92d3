import { CellInput } from '@/ui/grid/CellInput';
import { useText } from '@/i18n';
import { checkLiteral } from './literal';
import styles from './OnlineTable.module.css';
import { prepare, preparedLiteral, usePreparedLiteral } from './prepared';
import { isExpandable, type OnlineRow } from './treeRows';
import { useLiveItem } from './useLive';
import { useOpenField } from './useOpenField';

/** The value that waits for Write or Force, in angle brackets. */
export function PreparedCell({ runtimeId, row }: { runtimeId: string | null; row: OnlineRow }) {
  const literal = usePreparedLiteral(runtimeId, row.expression);
  if (literal === null || isExpandable(row)) return null;
  return <span className={styles.prepared}>{`<${literal}>`}</span>;
}

interface PreparedEditorProps {
  runtimeId: string;
  row: OnlineRow;
  initial: string | undefined;
  onDone: () => void;
}

/**
 * Types a literal; one of the wrong type or range is refused and nothing is prepared (DECL-43). Empty takes it back.
 * Nothing typed is lost while the controller has not sent the type yet: Enter is refused until it has.
 */
export function PreparedEditor({ runtimeId, row, initial, onDone }: PreparedEditorProps) {
  const t = useText();
  const item = useLiveItem(runtimeId, row.expression) ?? undefined;
  const handle = useOpenField();
  const checked = (text: string) => (item === undefined ? null : checkLiteral(text, item));
  const names = Object.keys(item?.enum ?? {});
  const refusal = (text: string): string | null => {
    if (text.trim() === '') return null;
    if (item?.flags?.includes('CONSTANT') === true) return t('online.constantFixed');
    if (item === undefined) return t('online.typeNotKnownYet');
    const result = checkLiteral(text, item);
    return result.ok ? null : t(result.reason, result.values);
  };
  return (
    <CellInput
      handle={handle}
      label={t('online.column.prepared')}
      value={preparedLiteral(runtimeId, row.expression) ?? ''}
      initial={initial}
      suggestions={names.length > 0 ? names : item?.kind === 'bool' ? ['TRUE', 'FALSE'] : undefined}
      check={refusal}
      onCommit={(text) => {
        const result = text.trim() === '' ? null : checked(text);
        prepare(runtimeId, row.expression, result?.ok === true ? result.literal : null);
        onDone();
      }}
      onCancel={onDone}
    />
  );
}
