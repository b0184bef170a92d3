import { useCallback } from 'react';
import { api } from '@/api/client';
import { GeneratedCodeDialog } from '@/editors/GeneratedCodeDialog';
import { useText } from '@/i18n';
import type { CamTable } from './camTable';

interface CodeDialogProps {
  projectId: string;
  name: string;
  cam: CamTable;
  close: () => void;
}

/** The declarations that a cam is compiled into (CAM-83, CAM-90). */
export function CodeDialog({ projectId, name, cam, close }: CodeDialogProps) {
  const t = useText();
  const ask = useCallback(async () => {
    const { text } = await api.post('/api/v1/projects/{project_id}/cams/code', {
      params: { path: { project_id: projectId } },
      body: { cam, name },
    });
    return text;
  }, [projectId, cam, name]);
  return <GeneratedCodeDialog title={t('cam.code')} ask={ask} close={close} />;
}
