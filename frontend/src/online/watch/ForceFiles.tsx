import { Download, Upload } from 'lucide-react';
import { useText } from '@/i18n';
import { IconButton } from '@/ui/Button';
import { notify } from '@/ui/notices';
import { prepare } from '../prepared';
import { FileButton } from './FileButton';
import { forcesFrom } from './listFile';

interface ForceFilesProps {
  runtimeId: string;
  /** Nothing is there to be exported without it. */
  onExport?: () => void;
}

/** Forces to a file and back: those of a file become prepared values, which Force Values (F7) then forces. */
export function ForceFiles({ runtimeId, onExport }: ForceFilesProps) {
  const t = useText();
  const take = (text: string) => {
    const { forces, wrong } = forcesFrom(text);
    for (const { expression, literal } of forces) prepare(runtimeId, expression, literal);
    if (wrong.length > 0) notify({ tone: 'error', title: t('forces.wrongLines', { lines: wrong.join(', ') }) });
    else notify({ tone: 'ok', title: t('forces.imported', { count: forces.length }) });
  };
  return (
    <>
      {onExport && <IconButton small icon={Download} label={t('forces.export')} onClick={onExport} />}
      <FileButton
        icon={Upload}
        label={t('forces.import')}
        disabledReason={null}
        named={onExport === undefined}
        onText={take}
      />
    </>
  );
}
