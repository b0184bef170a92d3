import { ArrowDown, ArrowUp } from 'lucide-react';
import type { KeyboardEvent } from 'react';
import { ofKind } from '@/api/objects';
import type { DataOfKind } from '@/api/types';
import { useDraft } from '@/editors/form/useDraft';
import { FormPage, Section } from '@/editors/form/FormPage';
import { NumberField } from '@/editors/form/NumberField';
import styles from '@/editors/form/Form.module.css';
import { useText } from '@/i18n';
import type { EditorProps } from '@/project/editorProps';
import { kindTitle, objectIcon } from '@/project/kinds';
import { IconButton } from '@/ui/Button';
import { Grid, type GridColumn } from '@/ui/grid/Grid';
import { useGridSelection } from '@/ui/grid/useGridSelection';
import { Tabs } from '@/ui/Tabs';
import own from './CncSettings.module.css';
import { movedColumn, toggledColumns, type TableColumns } from './columns';
import { PreprocessorTab } from './PreprocessorTab';

const SettingsIcon = objectIcon('cnc_settings');
const isTime = (value: number) => Number.isInteger(value) && value >= 1 && value <= 1_000_000;
const canStore = (settings: DataOfKind['cnc_settings']) => isTime(settings.interpolation_time_us);

/** Settings of all CNC programs of an application: path preprocessing, interpolation, columns of tables (CNCS-02). */
export default function CncSettingsEditor({ panelId, projectId, objectId }: EditorProps) {
  const t = useText();
  const draft = useDraft(panelId, projectId, objectId, ofKind('cnc_settings'), canStore);
  return (
    <FormPage draft={draft} wide>
      {(settings) => (
        <>
          <h1 className={styles.title}>
            <SettingsIcon size={20} />
            {kindTitle('cnc_settings')}
          </h1>
          <Tabs
            pages={[
              {
                id: 'preprocessor',
                title: t('cncSettings.preprocessor'),
                content: (
                  <PreprocessorTab
                    projectId={projectId}
                    chain={settings.preprocessing}
                    readOnly={draft.readOnly}
                    onChain={(preprocessing) => draft.change({ ...settings, preprocessing })}
                  />
                ),
              },
              {
                id: 'interpolation',
                title: t('cncSettings.interpolation'),
                content: (
                  <>
                    <NumberField
                      label={t('cncSettings.interpolationTime')}
                      unit="µs"
                      value={settings.interpolation_time_us}
                      error={isTime(settings.interpolation_time_us) ? null : t('cncSettings.timeRange')}
                      disabled={draft.readOnly !== null}
                      onValue={(interpolation_time_us) => draft.change({ ...settings, interpolation_time_us })}
                    />
                    <p className={own.note}>{t('cncSettings.interpolationNote')}</p>
                  </>
                ),
              },
              {
                id: 'table',
                title: t('cncSettings.table'),
                content: (
                  <>
                    <ColumnList
                      columns={settings.columns}
                      readOnly={draft.readOnly}
                      onColumns={(columns) => draft.change({ ...settings, columns })}
                    />
                    <p className={own.note}>{t('cncSettings.type')}</p>
                  </>
                ),
              },
            ]}
          />
        </>
      )}
    </FormPage>
  );
}

interface ColumnListProps {
  columns: TableColumns;
  readOnly: string | null;
  onColumns: (columns: TableColumns) => void;
}

function ColumnList({ columns, readOnly, onColumns }: ColumnListProps) {
  const t = useText();
  const selection = useGridSelection(columns.length);
  const { cursor, selected } = selection;
  const shift = (by: number) => {
    const next = cursor && movedColumn(columns, cursor.row, cursor.row + by);
    if (next === null || cursor === null) return;
    onColumns(next);
    selection.move({ row: cursor.row + by, column: cursor.column }, 'one');
  };
  const toggle = (rows: ReadonlySet<number>) => onColumns(toggledColumns(columns, rows));
  const onKey = (event: KeyboardEvent): boolean => {
    if (readOnly !== null || cursor === null) return false;
    if (event.key === ' ') toggle(selected);
    else if (event.shiftKey && event.key === 'ArrowUp') shift(-1);
    else if (event.shiftKey && event.key === 'ArrowDown') shift(1);
    else return false;
    event.preventDefault();
    return true;
  };
  const shown: GridColumn[] = [
    { id: 'visible', title: t('cncSettings.visible'), width: 72 },
    { id: 'name', title: t('cncSettings.column'), width: 240, grow: true },
  ];
  const reason = (by: number) =>
    readOnly ??
    (cursor === null || movedColumn(columns, cursor.row, cursor.row + by) === null ? t('cncSettings.choose') : null);
  return (
    <Section
      title={t('cncSettings.columns')}
      tools={
        <>
          <IconButton
            icon={ArrowUp}
            label={t('cncSettings.up')}
            shortcut="Shift+ArrowUp"
            disabledReason={reason(-1)}
            onClick={() => shift(-1)}
          />
          <IconButton
            icon={ArrowDown}
            label={t('cncSettings.down')}
            shortcut="Shift+ArrowDown"
            disabledReason={reason(1)}
            onClick={() => shift(1)}
          />
        </>
      }
    >
      <div className={own.list}>
        <Grid
          label={t('cncSettings.columns')}
          columns={shown}
          count={columns.length}
          keyOf={(row) => columns[row]?.name ?? ''}
          cell={(row, { id }) =>
            id === 'visible' ? (
              <input
                type="checkbox"
                tabIndex={-1}
                aria-label={t(`cnc.column.${columns[row]!.name}`)}
                checked={columns[row]!.visible}
                disabled={readOnly !== null}
                onChange={() => toggle(new Set([row]))}
              />
            ) : (
              t(`cnc.column.${columns[row]!.name}`)
            )
          }
          selected={selected}
          cursor={cursor}
          onCursor={selection.move}
          onKey={onKey}
          onEmptyClick={selection.clear}
        />
      </div>
    </Section>
  );
}
