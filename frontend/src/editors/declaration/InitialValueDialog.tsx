import { useMemo, useState } from 'react';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Field, TextInput } from '@/ui/Field';
import { useMemberSource } from '../assistant/useMemberSource';
import { Grid, type GridColumn } from '@/ui/grid/Grid';
import { useGridSelection } from '@/ui/grid/useGridSelection';
import styles from './Dialogs.module.css';
import { composeInitial, givenValues, initialLines, parseInitial, type GivenValues } from '@/iec/declaration/initial';
import { shapeOf } from '@/iec/declaration/types';

interface InitialValueDialogProps {
  projectId: string;
  name: string;
  type: string;
  initial: string;
  close: (initial?: string) => void;
}

/** Initial value of a variable with all its components (DECL-31). */
export function InitialValueDialog({ projectId, name, type, initial, close }: InitialValueDialogProps) {
  const t = useText();
  const members = useMemberSource(projectId, type);
  const shape = useMemo(() => shapeOf(type, members), [type, members]);
  const start = useMemo(
    () => givenValues(shape, initial.trim() === '' ? null : parseInitial(initial)),
    [shape, initial],
  );
  const [changed, setChanged] = useState<GivenValues | null>(null);
  const given = changed ?? start;
  const lines = useMemo(() => initialLines(shape, name, given), [shape, name, given]);
  const selection = useGridSelection(lines.length);
  const [value, setValue] = useState('');
  const chosen = [...selection.selected].map((row) => lines[row]).filter((line) => line !== undefined);
  const none = chosen.length === 0 ? t('decl.selectLines') : null;

  const apply = () => {
    const next: Record<string, string> = { ...given };
    for (const line of chosen) {
      // A value for a whole replaces what was given for its components.
      for (const path of Object.keys(next)) if (path !== line.path && isBelow(path, line.path)) delete next[path];
      next[line.path] = value.trim();
    }
    setChanged(next);
  };
  const reset = () => {
    const paths = chosen.map((line) => line.path);
    setChanged(
      Object.fromEntries(Object.entries(given).filter(([path]) => !paths.some((p) => path === p || isBelow(path, p)))),
    );
  };
  const columns: GridColumn[] = [
    { id: 'name', title: t('decl.component'), width: 200, grow: true, code: true },
    { id: 'value', title: t('decl.column.initial'), width: 160, grow: true, code: true },
    { id: 'type', title: t('decl.column.type'), width: 160, grow: true, code: true },
  ];
  return (
    <Dialog
      title={t('decl.initialTitle', { name })}
      width={640}
      onClose={() => close()}
      footer={
        <>
          <Button onClick={() => close()}>{t('action.cancel')}</Button>
          <Button variant="primary" onClick={() => close(composeInitial(shape, given))}>
            {t('st.ok')}
          </Button>
        </>
      }
    >
      <div className={styles.stack}>
        <div className={styles.lines}>
          <Grid
            label={t('decl.initialTitle', { name })}
            columns={columns}
            count={lines.length}
            keyOf={(row) => lines[row]?.path ?? String(row)}
            level={(row) => (lines[row]?.depth ?? 0) + 1}
            cell={(row, column) => {
              const line = lines[row];
              if (line === undefined) return null;
              if (column.id === 'name') return <span style={{ paddingLeft: line.depth * 14 }}>{line.label}</span>;
              if (column.id === 'type') return <span className={styles.default}>{line.type}</span>;
              return <span className={line.isDefault ? styles.default : styles.given}>{line.value}</span>;
            }}
            selected={selection.selected}
            cursor={selection.cursor}
            onCursor={(cursor, how) => {
              selection.move(cursor, how);
              if (how === 'one') setValue(lines[cursor.row]?.value ?? '');
            }}
          />
        </div>
        <Field label={t('decl.newValue')}>
          {(attributes) => (
            <div className={styles.withButton}>
              <TextInput
                {...attributes}
                value={value}
                onValue={setValue}
                onKeyDown={(event) => event.key === 'Enter' && none === null && value.trim() !== '' && apply()}
              />
              <Button disabledReason={none ?? (value.trim() === '' ? t('decl.valueNeeded') : null)} onClick={apply}>
                {t('decl.applyValue')}
              </Button>
              <Button disabledReason={none} onClick={reset}>
                {t('decl.resetValue')}
              </Button>
            </div>
          )}
        </Field>
      </div>
    </Dialog>
  );
}

function isBelow(path: string, whole: string): boolean {
  return path.startsWith(`${whole}.`) || path.startsWith(`${whole}[`);
}
