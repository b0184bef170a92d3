import { ofKind, shaped } from '@/api/objects';
import type { SettingsProps } from '@/project/kinds';
import { HeapFields } from './HeapFields';
import { ReserveFields } from './ReserveFields';
import { SourceFields } from './SourceFields';

/** The project settings of an application: the memory that it may take, when its source is stored in the controller. */
export default function SettingsPage({ object, readOnly, change }: SettingsProps) {
  const { data } = shaped(object, ofKind('application'));
  const disabled = readOnly !== null;
  return (
    <>
      <HeapFields application={data} disabled={disabled} onChange={(heap) => change({ ...data, heap })} />
      <ReserveFields
        application={data}
        disabled={disabled}
        onChange={(change_reserve) => change({ ...data, change_reserve })}
      />
      <SourceFields
        value={data.source_download}
        disabled={disabled}
        onChange={(source_download) => change({ ...data, source_download })}
      />
    </>
  );
}
