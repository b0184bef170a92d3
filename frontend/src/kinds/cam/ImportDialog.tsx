import { api } from '@/api/client';
import { useText } from '@/i18n';
import { notify } from '@/ui/notices';
import { TextImportDialog } from '@/ui/TextImportDialog';
import type { CamEdit } from './edit';

interface ImportDialogProps {
  projectId: string;
  edit: CamEdit;
  close: (answer?: true) => void;
}

/** Replaces the points of a cam by those of a text: chosen as file or pasted (CAM-80, CAM-82). */
export function ImportDialog({ projectId, edit, close }: ImportDialogProps) {
  const t = useText();
  const take = async (text: string) => {
    const found = await api.post('/api/v1/projects/{project_id}/cams/from-text', {
      params: { path: { project_id: projectId } },
      body: { cam: edit.cam, text },
    });
    edit.change(found.cam, null);
    if (found.removed_tappets > 0)
      notify({ tone: 'info', title: t('cam.tappetsRemoved', { count: found.removed_tappets }) });
  };
  return (
    <TextImportDialog
      title={t('cam.import')}
      texts={{
        description: t('cam.importText'),
        action: t('cam.importAction'),
        empty: t('cam.importEmpty'),
        chooseFile: t('cam.chooseFile'),
        text: t('cam.text'),
        tooLarge: (name) => t('cam.fault.fileSize', { name }),
      }}
      accept=".txt,.csv,.cam,.dat,text/plain,text/csv"
      largest={2_000_000}
      rows={12}
      placeholder={'0 0\n120 120\n360 360'}
      take={take}
      close={close}
    />
  );
}
