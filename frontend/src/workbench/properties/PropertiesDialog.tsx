import { Suspense } from 'react';
import { useObjects } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { kindOf, kindTitle, subkindTitle } from '@/project/kinds';
import { displayName } from '@/project/objectName';
import { treePath } from '@/project/tree';
import { Facts } from '@/ui/Facts';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Loading } from '@/ui/Empty';

interface PropertiesDialogProps {
  projectId: string;
  object: ObjectSummary;
  close: () => void;
}

/** What an object is and where; below it what its kind adds. */
export function PropertiesDialog({ projectId, object, close }: PropertiesDialogProps) {
  const t = useText();
  const { data: objects } = useObjects(projectId);
  const Own = kindOf(object.kind)?.properties;
  const kind = [kindTitle(object.kind), object.subkind && subkindTitle(object.subkind)].filter(Boolean).join(', ');
  return (
    <Dialog
      title={t('properties.title', { name: displayName(object) })}
      onClose={close}
      footer={<Button onClick={close}>{t('action.close')}</Button>}
    >
      <Facts>
        <dt>{t('properties.kind')}</dt>
        <dd>{kind}</dd>
        <dt>{t('properties.path')}</dt>
        <dd>{treePath(objects ?? [], object.id)}</dd>
        <dt>{t('properties.revision')}</dt>
        <dd>{object.revision}</dd>
      </Facts>
      {Own && (
        <Suspense fallback={<Loading />}>
          <Own projectId={projectId} objectId={object.id} />
        </Suspense>
      )}
    </Dialog>
  );
}
