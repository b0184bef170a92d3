import { ofKind, shaped } from '@/api/objects';
import type { SettingsProps } from '@/project/kinds';
import { Failed, Loading } from '@/ui/Empty';
import { useCompilerWarnings } from '@/workbench/compilerWarnings/useCompilerWarnings';
import { WarningsEditor } from '@/workbench/compilerWarnings/WarningsEditor';

/** The project settings of an application: which warnings of the compiler it reports. */
export default function WarningsPage({ object, readOnly, change }: SettingsProps) {
  const warnings = useCompilerWarnings();
  const { data } = shaped(object, ofKind('application'));
  if (warnings.error) return <Failed error={warnings.error} />;
  if (!warnings.data) return <Loading />;
  return (
    <WarningsEditor
      warnings={warnings.data}
      off={data.disabled_warnings ?? []}
      readOnly={readOnly}
      change={(disabled_warnings) => change({ ...data, disabled_warnings })}
    />
  );
}
