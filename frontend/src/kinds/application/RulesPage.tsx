import { ofKind, shaped } from '@/api/objects';
import type { StaticAnalysisData } from '@/api/types';
import { useText } from '@/i18n';
import type { SettingsProps } from '@/project/kinds';
import { Failed, Loading } from '@/ui/Empty';
import { Checkbox } from '@/ui/Field';
import { NO_RULES } from '@/workbench/staticAnalysis/model';
import { RulesEditor } from '@/workbench/staticAnalysis/RulesEditor';
import { useRules } from '@/workbench/staticAnalysis/useRules';

/** The project settings of an application: its coding rules. */
export default function RulesPage({ object, readOnly, change }: SettingsProps) {
  const t = useText();
  const rules = useRules();
  const { data } = shaped(object, ofKind('application'));
  const chosen = data.static_analysis ?? NO_RULES;
  const choose = (static_analysis: StaticAnalysisData) => change({ ...data, static_analysis });
  if (rules.error) return <Failed error={rules.error} />;
  if (!rules.data) return <Loading />;
  return (
    <>
      <Checkbox
        checked={chosen.with_build}
        disabled={readOnly !== null}
        onChecked={(with_build) => choose({ ...chosen, with_build })}
      >
        {t('analysis.withBuild')}
      </Checkbox>
      <RulesEditor rules={rules.data} chosen={chosen} readOnly={readOnly} change={choose} />
    </>
  );
}
