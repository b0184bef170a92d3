import { useEffect } from 'react';
import { useText } from '@/i18n';
import { Checkbox, Field, Select } from '@/ui/Field';
import { loadEditorSettings, setEditorSettings, useEditorSettings, type EditorSettings } from '@/text/settings';

const INDENTATIONS = ['2', '3', '4', '8', '0'] as const;
const CASES: readonly EditorSettings['formatKeywords'][] = ['upper', 'lower', 'keep'];

/** How formatting writes ST: indentation, case of keywords, blanks. */
export function FormatOptions() {
  const t = useText();
  useEffect(() => void loadEditorSettings(), []);
  const { formatIndent, formatKeywords, formatOperators, formatCommas } = useEditorSettings();
  return (
    <>
      <Field row label={t('format.indent')}>
        {({ id }) => (
          <Select
            id={id}
            value={String(formatIndent)}
            choices={INDENTATIONS.map((value) => ({
              value: value,
              text: value === '0' ? t('format.tab') : t('format.columns', { count: Number(value) }),
            }))}
            onValue={(value) => setEditorSettings({ formatIndent: Number(value) })}
          />
        )}
      </Field>
      <Field row label={t('format.keywords')}>
        {({ id }) => (
          <Select
            id={id}
            value={formatKeywords}
            choices={CASES.map((value) => ({ value, text: t(`format.${value}`) }))}
            onValue={(value) => setEditorSettings({ formatKeywords: value })}
          />
        )}
      </Field>
      <Field row label={t('format.blanks')}>
        {() => (
          <>
            <Checkbox checked={formatOperators} onChecked={(on) => setEditorSettings({ formatOperators: on })}>
              {t('format.operators')}
            </Checkbox>
            <Checkbox checked={formatCommas} onChecked={(on) => setEditorSettings({ formatCommas: on })}>
              {t('format.commas')}
            </Checkbox>
          </>
        )}
      </Field>
    </>
  );
}
