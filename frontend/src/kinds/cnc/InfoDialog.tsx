import { useCallback, useEffect, useState } from 'react';
import { api } from '@/api/client';
import type { components } from '@/api/schema';
import { numberText } from '@/editors/form/numbers';
import { GeneratedCodeDialog } from '@/editors/GeneratedCodeDialog';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { openDialog } from '@/ui/dialogs';
import { Loading } from '@/ui/Empty';
import { Facts } from '@/ui/Facts';
import { explain } from '@/ui/notices';
import styles from './Cnc.module.css';
import type { CncProgramData } from './properties';

type CncInfo = components['schemas']['CncInfo'];
type PathFacts = components['schemas']['CncPathFacts'];

interface InfoDialogProps {
  projectId: string;
  objectId: string;
  /** As the editor has it. */
  program: CncProgramData;
  name: string;
  close: () => void;
}

/** What is known of a program and its path, by the blocks that run on the controller (CNC-20, CNC-21). */
export function InfoDialog({ projectId, objectId, program, name, close }: InfoDialogProps) {
  const t = useText();
  const [info, setInfo] = useState<CncInfo | null>(null);
  const [refused, setRefused] = useState<string | null>(null);
  const order = useCallback(
    () => ({ params: { path: { project_id: projectId } }, body: { object_id: objectId, program } }),
    [projectId, objectId, program],
  );
  useEffect(() => {
    api
      .post('/api/v1/projects/{project_id}/cnc/info', order())
      .then(setInfo)
      .catch((error: unknown) => setRefused(explain(error).text ?? explain(error).title));
  }, [order]);
  const ask = useCallback(
    async () => (await api.post('/api/v1/projects/{project_id}/cnc/code', order())).text,
    [order],
  );
  const faulty = info !== null && (info.errors > 0 || info.path.fault !== null);
  return (
    <Dialog
      title={t('cnc.infoOf', { name })}
      width={520}
      onClose={close}
      footer={
        <>
          <Button
            disabledReason={info === null ? t('cnc.infoWaits') : faulty ? t('cnc.codeNeedsNoErrors') : null}
            onClick={() =>
              void openDialog((done) => <GeneratedCodeDialog title={t('cnc.code')} ask={ask} close={done} />)
            }
          >
            {t('cnc.showCode')}
          </Button>
          <Button onClick={close}>{t('action.close')}</Button>
        </>
      }
    >
      {refused !== null ? (
        <p role="alert">{refused}</p>
      ) : info === null ? (
        <Loading />
      ) : (
        <>
          <Facts>
            <dt>{t('cnc.programName')}</dt>
            <dd>{info.name}</dd>
            <dt>{t('cnc.blockVersion')}</dt>
            <dd>SM3_CNC {info.library}</dd>
            <dt>{t('cnc.lineCount')}</dt>
            <dd>{info.lines}</dd>
          </Facts>
          <h3 className={styles.heading}>{t('cnc.originalPath')}</h3>
          <Path facts={info.path} />
          {info.preprocessed && (
            <>
              <h3 className={styles.heading}>{t('cnc.preprocessedPath')}</h3>
              <Path facts={info.preprocessed} />
            </>
          )}
        </>
      )}
    </Dialog>
  );
}

function Path({ facts }: { facts: PathFacts }) {
  const t = useText();
  const { objects, length, duration, fault } = facts;
  return (
    <>
      <Facts>
        <dt>{t('cnc.objectCount')}</dt>
        <dd>{objects}</dd>
        <dt>{t('cnc.pathLength')}</dt>
        <dd>{numberText(Number(length.toPrecision(10)))} u</dd>
        <dt>{t('cnc.duration')}</dt>
        <dd>{duration === null ? t('cnc.noDuration') : `${numberText(Number(duration.toFixed(3)))} s`}</dd>
      </Facts>
      {fault && (
        <p role="alert">
          {fault.line === null ? fault.message : t('cnc.faultInLine', { line: fault.line + 1, text: fault.message })}
        </p>
      )}
    </>
  );
}
